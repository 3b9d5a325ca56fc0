//! Contact between bodies from its keys.

use super::build::{Build, join};
use super::keys::RawScene;
use super::lists::Contacts;
use super::words::{CONTACT_METHODS, CONTACT_NORMALS, ContactMethod};
use proctor_scene::{Contact, ContactNormal, Scene};

impl Build<'_> {
    /// The contacts, unless the manager switches them off.
    pub(super) fn contacts(&mut self, raw: &RawScene, scene: &mut Scene) {
        let manager = raw.contact_manager.as_ref();
        if manager.and_then(|m| m.active) == Some(false) {
            return;
        }
        scene.contact_distance = manager.and_then(|m| m.real_distance_correction_coefficient);
        let entries = match &raw.contact {
            None | Some(Contacts::Switch(false)) => return,
            Some(Contacts::Switch(true)) => {
                self.add(
                    "contact",
                    "true, which does not say which bodies",
                    "a list of contacts",
                );
                return;
            }
            Some(Contacts::List(entries)) => entries,
        };
        for (i, (name, entry)) in entries.0.iter().enumerate() {
            let path = name
                .as_ref()
                .map_or_else(|| format!("contact[{i}]"), |name| join("contact", name));
            let key = |key: &str| join(&path, key);
            let method = self.word_or(
                &key("method"),
                entry.method.as_ref(),
                CONTACT_METHODS,
                ContactMethod::Grid,
            );
            let friction = self.number(
                &key("friction"),
                entry.friction,
                "the coefficient of friction, 0 or greater",
            );
            let master = self.body_of_pair(&key("master_id"), entry.master_id);
            let slave = self.body_of_pair(&key("slave_id"), entry.slave_id);
            for (name, id) in [("master_id", master), ("slave_id", slave)] {
                if id.is_some_and(|id| self.divided_bodies.contains(&id)) {
                    self.add(
                        key(name),
                        "a body with layers or zones, which share one velocity field",
                        "a body of one material",
                    );
                }
            }
            if method == ContactMethod::Mortar {
                let id = entry.id.unwrap_or(i as i64 + 1);
                self.mortar_contact(&path, entry, id, friction, [master, slave], scene);
                continue;
            }
            self.refuse_mortar_keys(&path, entry);
            let normal = self.word_or(
                &key("normal_type"),
                entry.normal_type.as_ref(),
                CONTACT_NORMALS,
                ContactNormal::Collinear,
            );
            self.spelt(format!("contact[{}]", scene.contacts.len()), path.clone());
            if master.is_none() || slave.is_none() {
                self.stands_in(path.clone());
            }
            scene.contacts.push(Contact {
                name: path.clone(),
                id: entry.id.unwrap_or(i as i64 + 1),
                friction,
                master: master.unwrap_or(i64::MIN),
                slave: slave.unwrap_or(i64::MAX),
                normal,
            });
        }
    }

    fn body_of_pair(&mut self, path: &str, id: Option<i64>) -> Option<i64> {
        if id.is_none() {
            self.missing(path, "the id of a body");
        }
        id
    }
}
