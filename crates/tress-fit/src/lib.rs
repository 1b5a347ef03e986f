//! Polylines to super-helices.
