//! Alembic curves written to Ogawa files.
