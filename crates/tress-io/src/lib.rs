//! Grooms in and out of the files that artists use.
