//! `proctor report`: a record as a page.

use crate::exit::{Failure, Outcome};
use crate::record::Record;
use crate::report;
use clap::Args;
use proctor_files::output::atomic;
use std::io::Write;
use std::path::PathBuf;

/// Make the page of a record: verdict, cases, error against run time, speed, plans, machine.
///
/// The page is one file that needs no network. It shows what the record holds: `proctor` without a verb writes one
/// with everything, `verify`, `precision` and `bench` write their own parts with --json.
#[derive(Args)]
#[command(
    after_help = "Example: proctor verify --quick --json record.json; proctor report record.json"
)]
pub struct Report {
    /// Record (JSON)
    record: PathBuf,
    /// The page [default: the name of the record with .html]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Report {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let record = Record::read(&self.record).map_err(Failure::bad_input)?;
        let page = self.out.clone();
        let page = page.unwrap_or_else(|| self.record.with_extension("html"));
        if page == self.record {
            return Err(Failure::BadInput(format!(
                "{}: the page would replace the record; accepted: another name with --out",
                page.display()
            )));
        }
        let html = report::page(&record);
        atomic::write(&page, |file| file.write_all(html.as_bytes())).map_err(Failure::bad_input)?;
        writeln!(out, "page in {}", page.display())?;
        Ok(Outcome::Fine)
    }
}
