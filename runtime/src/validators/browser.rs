//! Chromium without a window: it is given a page, and what the page sends back is the answer.

use std::collections::HashMap;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Sender, channel};
use std::time::{Duration, Instant};

/// How long the browser may take for all that a page asks of it.
const PATIENCE: Duration = Duration::from_secs(900);
/// How long it may take to ask for the page.
const START: Duration = Duration::from_secs(90);
/// Names under which systems install it.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// Why there is no answer.
#[derive(Clone, Debug)]
pub enum Silence {
    /// Something is not installed, or cannot run here.
    Missing(String),
    /// Something went wrong.
    Failed(String),
}

/// The program's name, where it is installed.
#[must_use]
pub fn browser() -> Option<&'static str> {
    let is_there = |name: &&str| {
        let version = Command::new(name).arg("--version").output();
        version.is_ok_and(|output| output.status.success())
    };
    NAMES.into_iter().find(is_there)
}

/// Where the script `pullback` keeps judges that come in packages: `PULLBACK_JUDGES`, or a folder of the user's cache.
#[must_use]
pub fn judges() -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os("PULLBACK_JUDGES") {
        return Some(PathBuf::from(folder));
    }
    let cache = std::env::var_os("XDG_CACHE_HOME").map(PathBuf::from);
    let home = || Some(PathBuf::from(std::env::var_os("HOME")?).join(".cache"));
    Some(cache.or_else(home)?.join("pullback/judges"))
}

/// A page and the files that it asks for, by their paths.
#[derive(Debug, Default)]
pub struct Site {
    /// The page itself.
    pub page: String,
    /// Files by their paths.
    pub files: HashMap<String, Vec<u8>>,
}

/// A text as a literal of JavaScript between backquotes. Backquotes in it become plain quotes, and what would end a script is set
/// apart: in shaders both stand in comments only.
#[must_use]
pub fn literal(text: &str) -> String {
    let text = text
        .replace('\\', "\\\\")
        .replace('`', "'")
        .replace("${", "$ {")
        .replace("</", "< /");
    format!("`{text}`")
}

/// A process that ends with its owner.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Shows a page to the browser. The answer is what the page sends behind a line `done`.
///
/// # Errors
/// There is no browser, it has not what the page needs, or it does not answer.
pub fn ask(site: &Site) -> Result<String, Silence> {
    let failed = |problem: std::io::Error| Silence::Failed(problem.to_string());
    let missing = |what: &str| Silence::Missing(what.to_owned());
    let browser =
        browser().ok_or_else(|| missing("Chromium is not installed (Debian: chromium)"))?;
    let listener = TcpListener::bind("127.0.0.1:0").map_err(failed)?;
    let address = listener.local_addr().map_err(failed)?;
    let folder = tempfile::tempdir().map_err(failed)?;
    let _running = Command::new(browser)
        .args([
            "--headless=new",
            "--no-sandbox",
            "--no-first-run",
            "--disable-dev-shm-usage",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--enable-unsafe-webgpu",
            "--use-webgpu-adapter=swiftshader",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
        ])
        .arg(format!("--user-data-dir={}", folder.path().display()))
        .arg(format!("http://{address}/"))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .map(Running)
        .map_err(failed)?;
    let answer = served(&listener, site)?;
    match answer.strip_prefix("done\n") {
        Some(answer) => Ok(answer.to_owned()),
        None => Err(match answer.strip_prefix("missing ") {
            Some(what) => missing(&format!("{browser} has no {what}")),
            None => Silence::Failed(answer),
        }),
    }
}

/// Gives the page to who asks for it, and waits for what the page sends back. A browser that never asks cannot be started here.
fn served(listener: &TcpListener, site: &Site) -> Result<String, Silence> {
    let failed = |problem: std::io::Error| Silence::Failed(problem.to_string());
    listener.set_nonblocking(true).map_err(failed)?;
    let started = Instant::now();
    let mut asked = false;
    let (sender, answers) = channel();
    std::thread::scope(|scope| {
        while started.elapsed() < PATIENCE {
            if let Ok(answer) = answers.try_recv() {
                return Ok(answer);
            }
            match listener.accept() {
                Ok((stream, _)) => {
                    asked = true;
                    let sender = sender.clone();
                    // a browser opens connections that it does not use, so that none may hold up the others
                    scope.spawn(move || exchanged(stream, site, &sender));
                }
                Err(_) if !asked && started.elapsed() > START => {
                    return Err(Silence::Missing("Chromium cannot be started here".into()));
                }
                Err(_) => std::thread::sleep(Duration::from_millis(10)),
            }
        }
        Err(Silence::Failed(
            "the browser did not answer in time".to_owned(),
        ))
    })
}

/// Serves one request; the body of a POST is the answer.
fn exchanged(stream: TcpStream, site: &Site, answers: &Sender<String>) -> std::io::Result<()> {
    stream.set_nonblocking(false)?;
    stream.set_read_timeout(Some(Duration::from_secs(5)))?;
    let mut reader = BufReader::new(stream);
    let (mut head, mut length) = (String::new(), 0);
    reader.read_line(&mut head)?;
    loop {
        let mut line = String::new();
        reader.read_line(&mut line)?;
        if line.trim().is_empty() {
            break;
        }
        if let Some((_, value)) = line.to_ascii_lowercase().split_once("content-length:") {
            length = value.trim().parse().unwrap_or(0);
        }
    }
    let mut body = vec![0; length];
    reader.read_exact(&mut body)?;
    let mut stream = reader.into_inner();
    let path = head.split(' ').nth(1).unwrap_or("/");
    let content = match path {
        "/" => Some(site.page.as_bytes()),
        _ => site
            .files
            .get(path.trim_start_matches('/'))
            .map(Vec::as_slice),
    };
    let status = match (&content, head.starts_with("POST")) {
        (None, false) => "404 Not Found",
        _ => "200 OK",
    };
    let kind = match path.rsplit('.').next() {
        Some("js") => "text/javascript",
        Some("wasm") => "application/wasm",
        Some("pck") => "application/octet-stream",
        _ => "text/html; charset=utf-8",
    };
    let content = content.unwrap_or_default();
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\n\
         Cross-Origin-Opener-Policy: same-origin\r\nCross-Origin-Embedder-Policy: require-corp\r\nConnection: close\r\n\r\n",
        content.len()
    )?;
    stream.write_all(content)?;
    if head.starts_with("POST") {
        let _ = answers.send(String::from_utf8_lossy(&body).into_owned());
    }
    Ok(())
}
