//! Pictures and values on the processor, from the command line: asked for, and where there is no adapter.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Exit code, standard output and standard error of `pullback` in `folder`; without any Vulkan driver if `bare`.
fn pullback(folder: &Path, arguments: &[&str], input: &str, bare: bool) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pullback"));
    if bare {
        for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
            command.env(variable, "/nonexistent");
        }
    }
    let mut child = command
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child
        .stdin
        .take()
        .unwrap()
        .write_all(input.as_bytes())
        .unwrap();
    let output = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// Width, height and pixels of a picture, and the text of its metadata.
fn read(path: &Path) -> (u32, u32, Vec<u8>, String) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let info = reader.info();
    let texts = info.uncompressed_latin1_text.iter().map(|t| t.text.clone());
    let more = info.utf8_text.iter().map(|t| t.get_text().unwrap());
    let text: Vec<String> = texts.chain(more).collect();
    (info.width, info.height, pixels, text.join("\n"))
}

#[test]
fn a_machine_without_an_adapter_draws_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let small = [
        "render",
        "sin(x^2 + y^2)",
        "-o",
        "a.png",
        "--size",
        "33x20",
        "--samples",
        "1",
    ];
    let (code, _, errors) = pullback(folder.path(), &small, "", true);
    assert_eq!(code, 0, "{errors}");
    assert!(
        errors.contains("no graphics adapter: the processor, in f64, computes, which takes longer"),
        "{errors}"
    );
    let (width, height, pixels, text) = read(&folder.path().join("a.png"));
    assert_eq!((width, height), (33, 20));
    let distinct: std::collections::BTreeSet<_> = pixels.chunks(4).collect();
    assert!(distinct.len() > 20, "{} colours", distinct.len());
    assert!(text.contains("the processor, in f64"), "{text}");
    // what was asked for and is not there is an error still
    for choice in ["gpu", "software", "llvmpipe"] {
        let arguments = [small.as_slice(), &["--adapter", choice]].concat();
        let (code, _, errors) = pullback(folder.path(), &arguments, "", true);
        assert_eq!(code, 3, "{choice}: {errors}");
    }
    let (code, values, errors) = pullback(
        folder.path(),
        &["eval", "x/3", "--points", "-"],
        "1\n",
        true,
    );
    assert_eq!(
        (code, values.as_str()),
        (0, "0.3333333333333333\n"),
        "{errors}"
    );
}

#[test]
fn values_in_both_arithmetics() {
    let folder = tempfile::tempdir().unwrap();
    let check = |arguments: &[&str], input: &str, expected: &str| {
        let arguments = [&["eval", "--points", "-"], arguments].concat();
        let (code, text, errors) = pullback(folder.path(), &arguments, input, false);
        assert_eq!(
            (code, text.as_str()),
            (0, expected),
            "{arguments:?}: {errors}"
        );
        assert!(!errors.contains("adapter"), "{errors}");
    };
    check(
        &["x/3", "--adapter", "reference"],
        "1\n1e300\n",
        "0.3333333333333333\n3.3333333333333335e299\n",
    );
    check(
        &["x/3", "--adapter", "ieee32"],
        "1\n0.1\n",
        "0.33333334\n0.033333335\n",
    );
    check(&["x + 0.1", "--adapter", "reference"], "0\n", "0.1\n");
    // a tier that is asked for is kept: its constants have its digits
    check(
        &[
            "x + 0.1",
            "--adapter",
            "reference",
            "--precision",
            "accurate",
        ],
        "0\n",
        "0.10000000149011612\n",
    );
    check(
        &["x/3", "--adapter", "ieee32", "--precision", "double"],
        "1\n",
        "0.3333333333333333\n",
    );
    check(
        &["z^2", "--adapter", "reference", "--what", "derivative"],
        "1 2\n",
        "-3\t4\t2\t4\n",
    );
}

/// The processor has all tiers, and `auto` tries them there as it does on an adapter.
#[test]
fn the_cheapest_tier_is_chosen_in_exact_single_precision() {
    let folder = tempfile::tempdir().unwrap();
    let draw = |formula: &str, more: &[&str]| {
        let auto = [
            "--adapter",
            "ieee32",
            "--precision",
            "auto",
            "-o",
            "a.png",
            "--size",
            "24x18",
        ];
        let arguments = [&["render", formula], &auto[..], more].concat();
        let (code, _, errors) = pullback(folder.path(), &arguments, "", true);
        assert_eq!(code, 0, "{errors}");
        errors
    };
    let plain = draw("x + y", &[]);
    assert!(
        plain.contains("auto: fast; fast: differs by at most"),
        "{plain}"
    );
    let deep = draw("sin(1e7 x) + y", &["--center", "1,0", "--height", "1e-6"]);
    let wide = ["auto: extended; ", "auto: double; "];
    assert!(wide.iter().any(|tier| deep.contains(tier)), "{deep}");
}

#[test]
fn odd_pixels_are_found_without_an_adapter() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["probe", "√x + y", "--nan", "--size", "8x6"];
    let (code, out, errors) = pullback(folder.path(), &arguments, "", true);
    assert_eq!(code, 0, "{errors}");
    assert!(errors.contains("only the processor computes"), "{errors}");
    let count = out.matches("NaN       24 of 8x6").count();
    assert_eq!(count, 2, "{out}");
    assert!(
        out.contains("ieee32, accurate\n") && out.contains("\nreference, double\n"),
        "{out}"
    );
}
