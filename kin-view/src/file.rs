//! Writes pictures and pages to files.

use std::io;
use std::path::Path;

use kin::{Error, Result};

/// Writes a picture, making folders that are missing: as PNG if the file is called so, else as it
/// is.
///
/// Errors: a file that cannot be written; PNG without the feature `png`.
pub(crate) fn save_picture(path: &Path, svg: &str) -> Result<()> {
    match path.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("png") => {
            png(svg).and_then(|png| write(path, &png))
        }
        _ => write(path, svg.as_bytes()),
    }
    .map_err(|source| Error::File { path: path.to_path_buf(), source })
}

/// Writes a page, making folders that are missing.
pub(crate) fn save(path: &Path, text: &str) -> Result<()> {
    write(path, text.as_bytes()).map_err(|source| Error::File { path: path.to_path_buf(), source })
}

fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    path.parent().map_or(Ok(()), std::fs::create_dir_all)?;
    std::fs::write(path, bytes)
}

/// The picture at twice its size in pixels, on its own background.
#[cfg(feature = "png")]
fn png(svg: &str) -> io::Result<Vec<u8>> {
    use resvg::{tiny_skia, usvg};
    const SCALE: f32 = 2.0;
    let mut options = usvg::Options::default();
    options.fontdb_mut().load_system_fonts();
    let tree = usvg::Tree::from_str(svg, &options).map_err(io::Error::other)?;
    let width = (tree.size().width() * SCALE).ceil() as u32;
    let height = (tree.size().height() * SCALE).ceil() as u32;
    let mut pixels = tiny_skia::Pixmap::new(width, height)
        .ok_or_else(|| io::Error::other("the picture has a width or height of zero"))?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(io::Error::other)
}

#[cfg(not(feature = "png"))]
fn png(_: &str) -> io::Result<Vec<u8>> {
    Err(io::Error::new(
        io::ErrorKind::Unsupported,
        "PNG needs the feature `png` of kin-view. Write an SVG file, or enable the feature",
    ))
}
