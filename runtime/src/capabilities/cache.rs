//! Findings on disk: one file an adapter, in the user's cache folder.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Capabilities, Key};
use crate::{atomic_file, probe};

/// Grows with every change of what is kept.
const VERSION: u32 = 2;

#[derive(Serialize, Deserialize)]
struct Kept<T> {
    version: u32,
    /// Which texts were run: findings of others are stale.
    probe: String,
    capabilities: T,
}

/// The folder of this program among those for caches, if the user has one.
#[must_use]
pub fn cache_folder() -> Option<PathBuf> {
    folder_of(|name| std::env::var_os(name))
}

/// The folder for findings.
pub(super) fn folder() -> Option<PathBuf> {
    Some(cache_folder()?.join("adapters"))
}

/// Likewise, with another environment. XDG Base Directory Specification 0.8: a relative path is to be ignored.
fn folder_of(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    let absolute = |name| {
        variable(name)
            .map(PathBuf::from)
            .filter(|p| p.is_absolute())
    };
    let base = absolute("XDG_CACHE_HOME").or_else(|| {
        if cfg!(windows) {
            absolute("LOCALAPPDATA")
        } else if cfg!(target_os = "macos") {
            Some(absolute("HOME")?.join("Library/Caches"))
        } else {
            Some(absolute("HOME")?.join(".cache"))
        }
    })?;
    Some(base.join("pullback"))
}

/// What is kept of an adapter; nothing if that is missing, broken, or of another adapter, driver or probe.
pub(super) fn load(folder: &Path, key: &Key) -> Option<Capabilities> {
    let text = fs::read_to_string(folder.join(name(key))).ok()?;
    let kept: Kept<Capabilities> = serde_json::from_str(&text).ok()?;
    let fresh = kept.version == VERSION && kept.probe == fingerprint();
    (fresh && kept.capabilities.adapter == *key).then_some(kept.capabilities)
}

/// Keeps findings.
pub(super) fn store(folder: &Path, found: &Capabilities) -> io::Result<()> {
    let kept = Kept {
        version: VERSION,
        probe: fingerprint(),
        capabilities: found,
    };
    fs::create_dir_all(folder)?;
    let text = serde_json::to_string_pretty(&kept)?;
    atomic_file::write_text(&folder.join(name(&found.adapter)), &(text + "\n"))
}

/// A file's name for an adapter: readable, and its own.
fn name(key: &Key) -> String {
    let plain = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    let readable: String = key.name.chars().map(plain).take(40).collect();
    let whole = [&key.name, &key.driver, &key.backend].map(String::as_str);
    format!("{readable}-{:016x}.json", hash(&whole))
}

/// Which probe this is.
fn fingerprint() -> String {
    let mut parts = probe::TEXTS.to_vec();
    parts.extend(pullback_compiler::lower::Exactness::ALL.map(|form| form.wgsl()));
    parts.push(env!("CARGO_PKG_VERSION"));
    format!("{:016x}", hash(&parts))
}

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), the parts kept apart.
fn hash(parts: &[&str]) -> u64 {
    let bytes = parts.iter().flat_map(|part| part.bytes().chain([0]));
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capabilities::tests::ideal;

    #[test]
    fn findings_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().join("a/b");
        let mut found = ideal();
        found.single.special.zeros.push("0 - 0".into());
        found.single.rounding.quotient = 0.1 + 0.2;
        assert_eq!(load(&folder, &found.adapter), None);
        store(&folder, &found).unwrap();
        assert_eq!(load(&folder, &found.adapter), Some(found));
    }

    #[test]
    fn stale_and_broken_findings_are_none() {
        let folder = tempfile::tempdir().unwrap();
        let found = ideal();
        store(folder.path(), &found).unwrap();
        let file = folder.path().join(name(&found.adapter));
        let good = fs::read_to_string(&file).unwrap();
        let check = |text: &str| {
            assert_ne!(text, good);
            fs::write(&file, text).unwrap();
            assert_eq!(load(folder.path(), &found.adapter), None, "{text}");
        };
        check("");
        check("[");
        check(&good[..good.len() / 2]);
        let version = |n: u32| format!("\"version\": {n}");
        check(&good.replace(&version(VERSION), &version(VERSION + 1)));
        check(&good.replace(&fingerprint(), "0"));
        check(&good.replace("driver 1.2", "driver 1.3"));
        check(&good.replace("\"two_sum\": 0.0", "\"two_sum\": null"));
        fs::write(&file, &good).unwrap();
        assert_eq!(load(folder.path(), &found.adapter), Some(found));
    }

    #[test]
    fn adapters_have_files_of_their_own() {
        let mut key = ideal().adapter;
        let first = name(&key);
        assert!(
            first.starts_with("a-gpu--x--") && first.ends_with(".json"),
            "{first}"
        );
        key.driver.push('1');
        assert_ne!(name(&key), first);
    }

    #[test]
    fn a_folder_that_cannot_be_is_an_error_to_store_and_nothing_to_load() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let found = ideal();
        assert!(store(&file.join("below"), &found).is_err());
        assert_eq!(load(&file.join("below"), &found.adapter), None);
    }

    #[test]
    #[cfg(unix)]
    fn the_folder_follows_the_environment() {
        let check = |xdg: Option<&str>, home: Option<&str>, expected: Option<&str>| {
            let found = folder_of(|name| match name {
                "XDG_CACHE_HOME" => xdg.map(OsString::from),
                "HOME" => home.map(OsString::from),
                _ => None,
            });
            let expected = expected.map(|base| Path::new(base).join("pullback"));
            assert_eq!(found, expected, "{xdg:?} {home:?}");
        };
        let cache = if cfg!(target_os = "macos") {
            "/h/Library/Caches"
        } else {
            "/h/.cache"
        };
        check(Some("/x"), Some("/h"), Some("/x"));
        check(Some("x"), Some("/h"), Some(cache));
        check(Some(""), Some("/h"), Some(cache));
        check(None, None, None);
    }
}
