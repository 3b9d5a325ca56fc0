//! Laws at a material point against exact solutions, and what must hold of each whatever its values.

mod bands;
mod cam_clay;
mod channels;
mod check;
mod cone;
mod fluids;
mod gap;
mod granular_flow;
mod hencky;
mod marks;
mod pyramid;
mod reported;
mod returned;
mod softened;
mod spectrum;
mod support;
mod undrained_clay;
mod von_mises;
