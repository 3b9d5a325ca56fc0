//! The ground beyond the mesh: what stands at absorbing planes, and free ground that moves beside them.

mod beyond;
mod free_ground;
