//! Pictures of grooms.
