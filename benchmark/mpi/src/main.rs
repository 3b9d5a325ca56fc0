//! The `proctor-mpi` command: `mpirun -n N proctor-mpi run SCENE` runs one scene on N ranks.

#![forbid(unsafe_code)]

use proctor_ranks::Engine;
use std::process::ExitCode;

fn main() -> ExitCode {
    // A rank that unwinds would end MPI, for which it would wait for ever: the others wait for its messages.
    let print = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        print(panic);
        std::process::exit(101);
    }));
    let engine = match Engine::start() {
        Ok(engine) => engine,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::from(1);
        }
    };
    match proctor_benchmark::command_on(&engine.ranks()) {
        0 => ExitCode::SUCCESS,
        // Without the end of MPI, for which a rank that failed alone would wait for ever.
        code => std::process::exit(code.into()),
    }
}
