//! `palpate scene`: a template, a schema for editors, and the reference of the documents.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use palpate_files::write_atomically;
use palpate_jobs::documents::{Kind, kind, kinds, reference, schema, template};

use super::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::output;

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate scene --template --out scene.toml
      writes a scene with every key explained, and scene.schema.json, with which an editor with a
      TOML language server (Taplo, Even Better TOML) completes and checks it
  palpate scene --template tissue
      prints a tissue template
  palpate scene --schema protocol --out protocol.schema.json
      only the JSON Schema
  palpate scene --reference
      all keys of all documents, as Markdown

KIND is scene (also for a task), tissue, protocol, or the kind of a problem for `palpate solve`: indentation, \
hemisphere, tube, uniaxial or solid. `palpate validate FILE` checks a file after editing.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
#[group(id = "what", required = true, multiple = false, args = ["template", "schema", "reference"])]
pub(crate) struct Arguments {
    /// A template with every key explained.
    #[arg(long, value_name = "KIND", num_args = 0..=1, default_missing_value = "scene", value_parser = one_kind())]
    template: Option<Kind>,
    /// A JSON Schema, for completion and checks in editors.
    #[arg(long, value_name = "KIND", num_args = 0..=1, default_missing_value = "scene", value_parser = one_kind())]
    schema: Option<Kind>,
    /// All keys of all documents, as Markdown.
    #[arg(long)]
    reference: bool,
    /// The file to write; default: print.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

fn one_kind() -> impl TypedValueParser<Value = Kind> {
    PossibleValuesParser::new(kinds().into_iter().map(|kind| kind.word))
        .map(|word| kind(&word).expect("it is one of the words"))
}

/// Prints or writes the requested text.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let out = arguments.out.as_deref();
    if let (Some(kind), Some(out)) = (&arguments.template, out) {
        let schema_name = format!("{}.schema.json", kind.word);
        let files = [
            (out.with_file_name(&schema_name), schema(kind)),
            (out.to_owned(), template(kind, Some(&schema_name))),
        ];
        return write(&files, arguments);
    }
    let text = match (&arguments.template, &arguments.schema) {
        (Some(kind), _) => template(kind, None),
        (_, Some(kind)) => schema(kind),
        (None, None) => reference(),
    };
    match out {
        Some(out) => write(&[(out.to_owned(), text)], arguments),
        None => output::text(text),
    }
}

/// Writes the files, or none where one of them exists with another text.
fn write(files: &[(PathBuf, String)], arguments: &Arguments) -> Result<(), Failure> {
    let is_new = |(path, text): &&(PathBuf, String)| {
        !std::fs::read_to_string(path).is_ok_and(|own| own == *text)
    };
    let files: Vec<_> = files.iter().filter(is_new).collect();
    let claims = arguments
        .overwrite
        .claim(files.iter().map(|(path, _)| path))?;
    for (path, text) in files {
        write_atomically(path, text.as_bytes())?;
        output::line(format!("written: {}", path.display()))?;
    }
    drop(claims);
    Ok(())
}
