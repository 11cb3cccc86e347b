// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads scenes from RON files and writes them.

#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use ron::error::{Error as RonError, Position, Span, SpannedError};
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;

use super::nearest::nearest;
use super::{NamedFiles, PRESETS, Scene};
use crate::SceneError;

/// Largest scene file in bytes; sixteen sources and thirty-two species take some ten thousand.
const MAX_FILE_BYTES: u64 = 4 << 20;

impl Scene {
    /// The scene that a preset's name or a file's path stands for. A file wins over a preset of the same name. The
    /// files that it names are looked for beside it, and must lie there or below.
    ///
    /// # Errors
    /// [`SceneError::UnknownScene`] if there is neither, [`SceneError::Read`] for a file that cannot be read, and
    /// what [`Scene::from_ron`] finds in its text and [`Scene::check_files_below`] in what it names.
    pub fn load(name_or_path: &str) -> Result<Self, SceneError> {
        Self::load_naming(name_or_path, NamedFiles::Below)
    }

    /// The same for a scene that may name other files than those below its own folder.
    ///
    /// # Errors
    /// Those of [`Scene::load`].
    pub fn load_naming(name_or_path: &str, allowed: NamedFiles) -> Result<Self, SceneError> {
        let path = Path::new(name_or_path);
        match read(path) {
            Ok(bytes) => {
                let mut scene = Self::from_ron(decode(&bytes, name_or_path)?, name_or_path)?;
                let folder = path.parent().unwrap_or(path);
                for (_, named) in scene.files_mut() {
                    // Both parts are text, so nothing is lost.
                    *named = folder.join(&*named).to_string_lossy().into_owned();
                }
                if allowed == NamedFiles::Below {
                    scene.check_files_below(folder, name_or_path)?;
                }
                Ok(scene)
            }
            // Not found, or not even a path: part of it is a file, it is too long, it holds a zero byte.
            Err(source) => match (Self::preset(name_or_path), path.try_exists()) {
                (_, Ok(true)) => Err(SceneError::Read { path: path.into(), source }),
                (Some(scene), _) => Ok(scene),
                (None, Err(source)) if source.kind() == ErrorKind::PermissionDenied => {
                    Err(SceneError::Read { path: path.into(), source })
                }
                (None, _) => {
                    let names = || PRESETS.iter().map(|&(name, _)| name);
                    Err(SceneError::UnknownScene {
                        name: name_or_path.escape_debug().to_string(),
                        nearest: nearest(name_or_path, names()),
                        presets: names().collect::<Vec<_>>().join(", "),
                    })
                }
            },
        }
    }

    /// Reads and validates the text of a scene file. `file` is the name that errors give.
    ///
    /// # Errors
    /// [`SceneError::Syntax`] for text that is no scene, [`SceneError::Field`] for a value that is not allowed.
    pub fn from_ron(text: &str, file: &str) -> Result<Self, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
        let scene: Self = options.from_str(text).map_err(|error| syntax_error(text, file, &error))?;
        scene.validate(file)?;
        Ok(scene)
    }

    /// The text of a scene file; [`Scene::from_ron`] reads the same scene from it, bit for bit.
    pub fn to_ron(&self) -> String {
        let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
        let layout = PrettyConfig::new().new_line("\n").compact_arrays(true);
        options.to_string_pretty(self, layout).expect("a scene is made of numbers, names and lists") + "\n"
    }
}

/// The bytes of a file, if it is one and of a sensible size.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(io::Error::new(ErrorKind::IsADirectory, "a directory, not a scene file"));
    }
    let mut bytes = Vec::new();
    // The length of a device or pipe is unknown until it has been read.
    file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        let reason = format!("more than {MAX_FILE_BYTES} bytes; scene files are much smaller");
        return Err(io::Error::new(ErrorKind::FileTooLarge, reason));
    }
    Ok(bytes)
}

/// The text of a file.
fn decode<'a>(bytes: &'a [u8], file: &str) -> Result<&'a str, SceneError> {
    std::str::from_utf8(bytes).map_err(|error| {
        let valid = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
        let line = valid.matches('\n').count() + 1;
        let column = valid.rsplit('\n').next().map_or(0, |rest| rest.chars().count()) + 1;
        let message = "not UTF-8 text".into();
        SceneError::Syntax { file: file.to_owned(), line, column, message }
    })
}

/// Place at which the text goes wrong, and what might have been meant.
fn syntax_error(text: &str, file: &str, error: &SpannedError) -> SceneError {
    let ended = offset(text, error.span.end) == text.len();
    let mut message = match &error.code {
        _ if text.trim().is_empty() => "empty; the smallest scene is ()".into(),
        RonError::ExpectedComma
        | RonError::ExpectedStructLikeEnd
        | RonError::ExpectedArrayEnd
        | RonError::ExpectedNamedStructLike(_)
            if ended =>
        {
            "Unexpected end; a closing bracket is missing".into()
        }
        RonError::ExpectedComma => "Expected a comma or a closing bracket".into(),
        RonError::IntegerOutOfBounds => "Expected a whole number, not negative and not this large".into(),
        RonError::MissingStructField { field, .. } => format!("`{field}` is missing before this"),
        code => code.to_string(),
    };
    let meant = match &error.code {
        RonError::NoSuchStructField { expected, found, .. }
        | RonError::NoSuchEnumVariant { expected, found, .. } => nearest(found, expected.iter().copied()),
        _ => None,
    };
    if let Some(meant) = meant {
        message += &format!("; did you mean `{meant}`?");
    }
    let Position { line, col: column } = if ended { error.span.end } else { start(text, &error.span) };
    SceneError::Syntax { file: file.to_owned(), line, column, message }
}

/// Number of bytes before a position, at most all of them.
fn offset(text: &str, position: Position) -> usize {
    let before: usize = text.split_inclusive('\n').take(position.line - 1).map(str::len).sum();
    let line = text[before..].chars().take(position.col - 1);
    before + line.map(char::len_utf8).sum::<usize>()
}

/// Beginning of a faulty part. Spans may begin with the space and the comments in front of it.
fn start(text: &str, &Span { start, end }: &Span) -> Position {
    let from = offset(text, start);
    let span = &text[from..offset(text, end).max(from)];
    let mut rest = span.trim_start();
    while let Some(comment) = rest.strip_prefix("//") {
        rest = comment.split_once('\n').map_or("", |(_, rest)| rest).trim_start();
    }
    let skipped = &span[..span.len() - rest.len()];
    match skipped.rsplit_once('\n') {
        Some((above, last)) => {
            let line = start.line + above.matches('\n').count() + 1;
            Position { line, col: last.chars().count() + 1 }
        }
        None => Position { line: start.line, col: start.col + skipped.chars().count() },
    }
}
