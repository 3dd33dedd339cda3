//! fogcoil
