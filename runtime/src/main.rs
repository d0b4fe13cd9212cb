//! The command line of pullback.

mod cli;

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use cli::{Arguments, Console};

fn main() -> ExitCode {
    quieten_loader();
    let arguments = Arguments::read();
    let terminal = io::stderr().is_terminal();
    let console = Console {
        color: terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        progress: terminal && !arguments.quiet,
        quiet: arguments.quiet,
    };
    // The library turns the panics of drivers into errors; those must not print.
    std::panic::set_hook(Box::new(|_| {}));
    let worker = std::thread::Builder::new()
        .stack_size(pullback_runtime::STACK)
        .spawn(move || cli::run(arguments, &console));
    let code = match worker.map(std::thread::JoinHandle::join) {
        Ok(Ok(code)) => code,
        Ok(Err(panic)) => {
            let message = panic
                .downcast_ref::<String>()
                .map(String::as_str)
                .or_else(|| panic.downcast_ref::<&str>().copied())
                .unwrap_or("unknown cause");
            say(&format!(
                "error: internal error, please report it: {message}"
            ));
            101
        }
        Err(error) => {
            say(&format!("error: no thread could be started: {error}"));
            3
        }
    };
    ExitCode::from(code)
}

/// Mesa's device selection layer looks for a desktop, and where there is none it complains on the standard error at
/// every start. We choose the device ourselves, so it is switched off there.
fn quieten_loader() {
    if cfg!(target_os = "linux") && std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: called first in `main`, before any other thread exists. The layer reads nothing but the environment.
        #[allow(unsafe_code)]
        unsafe {
            std::env::set_var("NODEVICE_SELECT", "1");
        }
    }
}

/// Writes a line to the standard error, if there still is one.
fn say(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}
