//! Creates an index page with links to many pages.

use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kin::{Error, Result};

use crate::file;
use crate::page::{filled, fingerprint};
use crate::picture::escaped;

const INDEX: &str = include_str!("index.html");
const STYLE: &str = include_str!("index.css");

/// An index of pages. Each page is in a separate folder next to the index, with an animated picture
/// and other files.
pub struct Gallery {
    title: String,
    text: String,
    entries: Vec<Entry>,
}

struct Entry {
    folder: String,
    title: String,
    text: String,
}

impl Gallery {
    /// Creates an empty index with a heading and a short text.
    pub fn new(title: &str, text: &str) -> Gallery {
        Gallery { title: title.to_string(), text: text.to_string(), entries: Vec::new() }
    }

    /// Adds the page `FOLDER/index.html` with a title and a description.
    ///
    /// The picture of the entry is `FOLDER/animated.svg`. The index lists the other files of the
    /// folder.
    pub fn entry(mut self, folder: &str, title: &str, text: &str) -> Gallery {
        self.entries.push(Entry {
            folder: folder.to_string(),
            title: title.to_string(),
            text: text.to_string(),
        });
        self
    }

    /// Writes `index.html` into the folder that contains the folders of all entries.
    ///
    /// Errors: the page or picture of an entry is missing; Kin cannot write the file. The error
    /// contains the path.
    pub fn save(&self, folder: impl AsRef<Path>) -> Result<()> {
        let folder = folder.as_ref();
        let entries =
            self.entries.iter().map(|entry| entry.html(folder)).collect::<Result<String>>()?;
        let parts = [
            ("fingerprint", fingerprint(STYLE)),
            ("title", escaped(&self.title)),
            ("text", escaped(&self.text)),
            ("style", STYLE.to_string()),
            ("entries", entries),
        ];
        file::save(&folder.join("index.html"), &filled(INDEX, &parts))
    }
}

impl Entry {
    fn html(&self, root: &Path) -> Result<String> {
        let folder = root.join(&self.folder);
        let read =
            |path: PathBuf| std::fs::read(&path).map_err(|source| Error::File { path, source });
        let picture = STANDARD.encode(read(folder.join("animated.svg"))?);
        read(folder.join("index.html"))?;
        let here = escaped(&self.folder);
        let title = escaped(&self.title);
        let text = escaped(&self.text);
        let files = std::fs::read_dir(&folder)
            .map_err(|source| Error::File { path: folder.clone(), source })?;
        let mut files: Vec<String> =
            files.filter_map(|file| file.ok()?.file_name().into_string().ok()).collect();
        files.retain(|name| !matches!(name.as_str(), "index.html" | "animated.svg"));
        files.sort();
        let links: Vec<String> = files
            .iter()
            .map(|name| escaped(name))
            .map(|name| format!("<a href=\"{here}/{name}\">{name}</a>"))
            .collect();
        Ok(format!(
            "<article><a href=\"{here}/index.html\"><img alt=\"{title}\" src=\"data:image/svg+xml;base64,{picture}\"></a>\n\
             <h2><a href=\"{here}/index.html\">{title}</a></h2>\n<p>{text}</p>\n<p>{}</p></article>\n",
            links.join(" · ")
        ))
    }
}
