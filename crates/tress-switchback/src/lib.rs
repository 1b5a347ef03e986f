//! Switchbacks: coils that change hands, exact and as published.
