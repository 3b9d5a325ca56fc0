//! Soil with water in its pores: skeleton and water as two velocities on one set of particles.

mod column;
mod drag;
mod held;
mod permeability;
mod planes;
mod rest;
mod series;
mod standing;
mod steps;
mod support;
