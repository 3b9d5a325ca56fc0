//! A scene as the text of a scene file of this program, with mortar contact, which no other program reads.

use serde_json::{Value, json};

use super::words::{DETECTIONS, ENFORCEMENTS, FOLLOWS};
use super::write::{Omission, SceneWriter, refuse, word, write};
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_scene::{BodyBoundary, Mortar, MortarContact, RigidLine, Scene, Vertices};

/// The scene as a scene file of this program has it: as [`fn@write`], and rigid lines, boundaries and mortar contact in the plane.
///
/// # Errors
/// [`Omission`]: as [`fn@write`] but for these; rigid surfaces of mortar contact, boundaries of triangles or of several
/// polylines, and lines that move.
pub fn write_own(scene: &Scene) -> Result<SceneWriter, Omission> {
    let mut plain = scene.clone();
    let mortar = std::mem::take(&mut plain.mortar);
    let mut written = write(&plain)?;
    refuse(
        !mortar.facets.is_empty(),
        "a rigid surface of mortar contact",
    )?;
    boundaries(scene, &mortar, &mut written.scene)?;
    let lines: Vec<Value> = mortar.lines.iter().map(line).collect::<Result<_, _>>()?;
    if !lines.is_empty() {
        written.scene["rigid_line"] = lines.into();
    }
    if !mortar.contacts.is_empty() {
        let mut list = written.scene["contact"]
            .as_array()
            .cloned()
            .unwrap_or_default();
        list.extend(mortar.contacts.iter().map(contact));
        written.scene["contact"] = list.into();
    }
    Ok(written)
}

/// Adds the boundaries to their bodies.
fn boundaries(scene: &Scene, mortar: &Mortar, keys: &mut Value) -> Result<(), Omission> {
    for (index, body) in scene.bodies.iter().enumerate() {
        let own = mortar.boundaries.iter().find(|b| b.body == body.id);
        if let Some(BodyBoundary {
            vertices, follow, ..
        }) = own
        {
            let keys = &mut keys["body"][index];
            match vertices {
                Vertices::Spacing(length) => keys["boundary_segment"] = (*length).into(),
                Vertices::Given(chains) => {
                    let one = one(chains, "a boundary")?;
                    keys["boundary"] = points(one);
                    keys["boundary_closed"] = (one.side != BoundarySide::Open).into();
                }
                Vertices::Surface(_) => refuse(true, "a boundary of triangles")?,
            }
            keys["boundary_follows"] = word(FOLLOWS, follow).into();
        }
    }
    Ok(())
}

fn line(line: &RigidLine) -> Result<Value, Omission> {
    refuse(line.motion.is_some(), "the motion of a rigid line")?;
    let one = one(&line.chains, "a rigid line")?;
    Ok(json!({ "id": line.id, "points": points(one), "closed": one.side != BoundarySide::Open }))
}

/// The one polyline of something.
fn one<'a>(chains: &'a [Chain], of: &str) -> Result<&'a Chain, Omission> {
    match chains {
        [one] if one.side != BoundarySide::Hole => Ok(one),
        _ => Err(Omission {
            what: format!("{of} of several polylines"),
        }),
    }
}

fn points(chain: &Chain) -> Value {
    let points = chain.points.iter().map(|point| json!([point.x, point.y]));
    points.collect::<Vec<_>>().into()
}

fn contact(contact: &MortarContact) -> Value {
    let mut keys = json!({
        "method": "mortar", "id": contact.id, "master_id": contact.master, "slave_id": contact.slave,
        "friction": contact.friction, "critical_gap": contact.critical_gap,
        "normal_stiffness": contact.normal_stiffness,
        "enforcement": word(ENFORCEMENTS, &contact.enforcement),
        "detection": word(DETECTIONS, &contact.detection),
    });
    if contact.friction > 0.0 {
        keys["tangential_stiffness"] = contact.tangential_stiffness.into();
    }
    keys
}
