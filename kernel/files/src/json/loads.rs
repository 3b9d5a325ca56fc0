//! Loads and prescribed motions, built from their keys.

use super::build::Build;
use super::keys::{RawEarthquake, RawScene};
use super::lists::VectorOrTable;
use super::materials::entry_path;
use super::words::{BASES, Base, PLANES, QUANTITIES, Quantity, RECORDED_MOTIONS, RecordedMotion};
use crate::records;
use proctor_scene::{BaseMotion, BoxLoad, HeldBox, History, Motion, PointLoad, Scene, Traction};

impl Build<'_> {
    pub(super) fn loads(&mut self, raw: &RawScene, scene: &mut Scene) {
        match raw.earthquake.as_ref().and_then(|raw| self.earthquake(raw)) {
            Some((Base::Rigid, motion)) => scene.base_motion = Some(motion),
            Some((Base::Compliant, motion)) => scene.ground_beyond.incoming = Some(motion),
            None => {}
        }
        scene.ground_beyond.thickness = raw.absorbing_springs;
        for (i, pair) in raw.nodal_point_load.iter().flatten().enumerate() {
            let path = format!("nodal_point_load[{i}]");
            if let [position, force] = &pair[..] {
                scene.point_loads.push(PointLoad {
                    position: self.components(&format!("{path}[0]"), position),
                    force: self.components(&format!("{path}[1]"), force),
                });
            } else {
                // Keeps the numbers of the loads behind it.
                scene.point_loads.push(PointLoad {
                    position: [f64::NAN; 3],
                    force: [f64::NAN; 3],
                });
                let found = format!("a list of length {}", pair.len());
                self.add(path, found, "a pair: a position [m] and a force [N]");
            }
        }
        let (lower, upper) = ("the lower corner [m]", "the upper corner [m]");
        for (i, raw) in raw.held_box.iter().flatten().enumerate() {
            let key = |key: &str| format!("held_box[{i}].{key}");
            scene.held_boxes.push(HeldBox {
                p1: self.vector(&key("point_p1"), raw.point_p1.as_ref(), lower),
                p2: self.vector(&key("point_p2"), raw.point_p2.as_ref(), upper),
            });
        }
        for (i, raw) in raw.traction.iter().flatten().enumerate() {
            let key = |key: &str| format!("traction[{i}].{key}");
            scene.tractions.push(Traction {
                p1: self.vector(&key("point_p1"), raw.point_p1.as_ref(), lower),
                p2: self.vector(&key("point_p2"), raw.point_p2.as_ref(), upper),
                traction: self.traction(&key("traction"), raw.traction.as_ref()),
            });
        }
        for (i, raw) in raw.box_load.iter().flatten().enumerate() {
            let key = |key: &str| format!("box_load[{i}].{key}");
            scene.box_loads.push(BoxLoad {
                p1: self.vector(&key("point_p1"), raw.point_p1.as_ref(), lower),
                p2: self.vector(&key("point_p2"), raw.point_p2.as_ref(), upper),
                force: self.vector(&key("force"), raw.force.as_ref(), "the total force [N]"),
            });
        }
        let distributed = raw.load_distributed_box.iter().flat_map(|all| &all.0);
        for (i, (name, raw)) in distributed.enumerate() {
            let path = entry_path("load_distributed_box", i, name.as_deref());
            let own = format!("box_load[{}]", scene.box_loads.len());
            self.spelt(own, path.clone());
            let key = |key: &str| format!("{path}.{key}");
            scene.box_loads.push(BoxLoad {
                p1: self.vector(&key("point_p1"), raw.point_p1.as_ref(), lower),
                p2: self.vector(&key("point_p2"), raw.point_p2.as_ref(), upper),
                force: self.vector(&key("load"), raw.load.as_ref(), "the total force [N]"),
            });
        }
    }

    fn traction(&mut self, path: &str, given: Option<&VectorOrTable>) -> History {
        let Some(given) = given else {
            self.missing(
                path,
                "the traction [Pa], or rows of a time [s] and a traction",
            );
            return [f64::NAN; 3].into();
        };
        self.motion(path, given)
    }

    /// The base and its motion, if it is active and its record can be read: of a compliant base that of the incoming wave.
    fn earthquake(&mut self, raw: &RawEarthquake) -> Option<(Base, BaseMotion)> {
        // The manuals' program takes a missing switch for `false`; a record that is silently not used is worth
        // an error.
        match raw.active {
            Some(true) => {}
            Some(false) => return None,
            None => {
                self.missing("earthquake.active", "true or false");
                return None;
            }
        }
        let axes = self.dimension.axes();
        let mut plane = (axes - 1, 0);
        if let Some(word) = &raw.plane {
            plane = self.word_or("earthquake.plane", Some(word), PLANES, plane);
            if plane.0 >= axes {
                self.add(
                    "earthquake.plane",
                    format!("{word:?}, a plane of z in two dimensions"),
                    "planes of x and y",
                );
            }
        }
        let quantity = self.word_or(
            "earthquake.quantity",
            raw.quantity.as_ref(),
            QUANTITIES,
            Quantity::Acceleration,
        );
        let base = self.word_or("earthquake.base", raw.base.as_ref(), BASES, Base::Rigid);
        let recorded = self.word_or(
            "earthquake.motion",
            raw.motion.as_ref(),
            RECORDED_MOTIONS,
            RecordedMotion::Outcrop,
        );
        if base == Base::Rigid && raw.motion.is_some() {
            self.add(
                "earthquake.motion",
                "the motion of a wave, where the base is rigid and moves as the record says",
                "no `motion`, or `base` \"compliant\"",
            );
        }
        let Some(file) = &raw.file else {
            self.missing("earthquake.file", "the path of a record");
            return None;
        };
        match records::read(&self.folder.join(file), raw.header, self.dimension) {
            Ok(mut history) => {
                if base == Base::Compliant && recorded == RecordedMotion::Outcrop {
                    for value in history.values.iter_mut().flatten() {
                        *value *= 0.5;
                    }
                }
                let motion = BaseMotion {
                    axis: plane.0,
                    side: plane.1,
                    motion: match quantity {
                        Quantity::Acceleration => Motion::Acceleration(history),
                        Quantity::Velocity => Motion::Velocity(history),
                    },
                };
                Some((base, motion))
            }
            Err(error) => {
                self.add_all("earthquake.file", error);
                None
            }
        }
    }
}
