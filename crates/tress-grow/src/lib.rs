//! From guides to a head of coils: phase locking, period skipping, roots.
