//! fem-core
