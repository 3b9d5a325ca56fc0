//! Closed-form solutions as plain functions of position and time.
