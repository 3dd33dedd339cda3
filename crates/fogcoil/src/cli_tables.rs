//! Files of a table: one, or a folder with several formats and a page.

use std::io::Write;
use std::path::{Path, PathBuf};

use fogcoil::output::{Content, make_folder};
use fogcoil::tabular::{Format, Table, bytes};
use fogcoil::{Error, FileError};

use crate::progress::Progress;

/// Files of a table, and of its page.
pub(crate) struct Tables {
    folder: Option<PathBuf>,
    tables: Vec<(PathBuf, Format)>,
    page: Option<PathBuf>,
}

const TABLE: &str = "table";
const PAGE: &str = "report.html";

impl Tables {
    /// The table as one file, its format by the end of its name; as a folder, if it is one or its name has no end.
    pub(crate) fn at(out: &Path) -> Result<Self, Error> {
        if out.is_dir() || (out.extension().is_none() && out != Path::new("-")) {
            return Ok(Self::within(out, &[Format::Csv, Format::Parquet]));
        }
        Ok(Self { folder: None, tables: vec![(out.to_owned(), Format::of(out, &[Format::Parquet, Format::Csv])?)], page: None })
    }

    /// The table in a folder, in these formats, with a page.
    pub(crate) fn within(folder: &Path, formats: &[Format]) -> Self {
        let table = |format: &Format| (folder.join(TABLE).with_extension(format.end()), *format);
        Self { folder: Some(folder.to_owned()), tables: formats.iter().map(table).collect(), page: Some(folder.join(PAGE)) }
    }

    /// Path beside which rows are kept until the table is written.
    pub(crate) fn stem(&self) -> PathBuf {
        match &self.folder {
            Some(folder) => folder.join(TABLE),
            None => self.tables[0].0.clone(),
        }
    }

    /// Every file that is written.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        self.tables.iter().map(|(path, _)| path).chain(&self.page).map(PathBuf::as_path)
    }

    /// Makes the folder, if there is one.
    pub(crate) fn make_folder(&self) -> Result<(), FileError> {
        self.folder.as_deref().map_or(Ok(()), make_folder)
    }

    /// Writes the table and the page, and `more`, all or none.
    pub(crate) fn save<'a>(
        &'a self,
        table: &Table,
        page: impl FnOnce() -> String,
        more: Vec<(&'a Path, Content<'a>)>,
        progress: &Progress,
    ) -> Result<(), Error> {
        let written = self.tables.iter().map(|(path, format)| Ok((path, bytes(table, *format)?)));
        let written: Vec<(&PathBuf, Vec<u8>)> = written.collect::<Result<_, Error>>()?;
        let writers: Vec<_> = written.iter().map(|(path, bytes)| (path, move |to: &mut dyn Write| to.write_all(bytes))).collect();
        let mut files: Vec<(&Path, Content)> =
            writers.iter().map(|(path, write)| (path.as_path(), Content::Written(write))).collect();
        files.extend(self.page.as_deref().map(|path| (path, Content::Text(page()))));
        files.extend(more);
        progress.save(&files)
    }
}
