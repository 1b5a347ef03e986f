//! Procedural grooms, forward and backward.
