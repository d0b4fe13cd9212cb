use std::fs::File;
use std::io::BufReader;

use super::*;

const CLIP: Clip = Clip {
    size: Size {
        width: 40,
        height: 30,
    },
    frames: 3,
    rate: 20.0,
};

/// A frame of one hue that gets brighter to the right.
fn draw(frame: u32) -> Result<Vec<u8>, Error> {
    let pixel = |k: u32| {
        let light = (k % 40 * 6) as u8;
        match frame {
            0 => [light, 0, 0, 255],
            1 => [0, light, 0, 255],
            _ => [0, 0, light, 255],
        }
    };
    Ok((0..1200).flat_map(pixel).collect())
}

fn written(name: &str, container: Container) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    write(&path, container, CLIP, &mut draw).unwrap();
    (folder, path)
}

#[test]
fn an_apng_holds_every_pixel_of_every_frame() {
    let (_folder, path) = written("a.apng", Container::Apng);
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).unwrap()))
        .read_info()
        .unwrap();
    let control = *reader.info().animation_control().unwrap();
    assert_eq!((control.num_frames, control.num_plays), (3, 0));
    for frame in 0..3 {
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, draw(frame).unwrap());
        let delay = reader.info().frame_control().unwrap();
        assert_eq!((delay.delay_num, delay.delay_den), (50, 1000));
    }
}

#[test]
fn a_gif_shows_the_mean_colour_of_each_place() {
    let (_folder, path) = written("a.gif", Container::Gif);
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(File::open(path).unwrap()).unwrap();
    assert_eq!(decoder.repeat(), ::gif::Repeat::Infinite);
    for number in 0..3 {
        let frame = decoder.read_next_frame().unwrap().unwrap();
        assert_eq!(frame.delay, 5);
        let expected = draw(number).unwrap();
        // columns of 4 x 30 pixels: error diffusion keeps their mean
        for column in 0..10 {
            for channel in 0..4 {
                let mean = |pixels: &[u8]| {
                    let places = (0..1200).filter(|k| k % 40 / 4 == column);
                    places
                        .map(|k| f64::from(pixels[4 * k + channel]))
                        .sum::<f64>()
                        / 120.0
                };
                let (found, wanted) = (mean(&frame.buffer), mean(&expected));
                assert!(
                    (found - wanted).abs() < 3.0,
                    "{number} {column} {channel}: {found} {wanted}"
                );
            }
        }
    }
    assert!(decoder.read_next_frame().unwrap().is_none());
}

#[test]
fn a_frame_that_fails_leaves_no_file() {
    for (name, container) in [("a.gif", Container::Gif), ("a.apng", Container::Apng)] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        let failed = write(&path, container, CLIP, &mut |frame| match frame {
            0 => draw(0),
            _ => Err(Error::Invalid {
                reason: "no more".into(),
            }),
        });
        assert!(matches!(failed, Err(Error::Invalid { .. })));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

#[test]
fn containers_by_name() {
    let container = |name: &str| Container::of(Path::new(name));
    assert_eq!(container("a.GIF"), Some(Container::Gif));
    assert_eq!(container("a.b.apng"), Some(Container::Apng));
    assert_eq!(container("gif"), None);
    assert_eq!(container("a.png"), None);
}
