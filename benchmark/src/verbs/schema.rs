//! `proctor schema`: the JSON Schema of scene files.

use crate::exit::{Failure, Outcome};
use clap::Args;
use proctor_files::json;
use std::io::Write;

/// Print the JSON Schema of scene files, for editors.
#[derive(Args)]
#[command(
    after_help = "Example: proctor schema > scene.schema.json, then name that file \
    in the JSON schema settings of your editor."
)]
pub struct Schema {}

impl Schema {
    // Verbs have the same signature, whatever they read.
    #[expect(
        clippy::unused_self,
        reason = "a verb is run through its options, also where it has none"
    )]
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let text = serde_json::to_string_pretty(&json::schema()).map_err(std::io::Error::from)?;
        writeln!(out, "{text}")?;
        Ok(Outcome::Fine)
    }
}
