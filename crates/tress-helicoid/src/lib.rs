//! Generalized helicoids: one hair that knows its neighbours.
