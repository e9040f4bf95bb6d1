//! Values that a function may return without having done anything.

use syn::{GenericArgument, PathArguments, Type};

/// A parameter of a function, and its type as it is written.
pub struct Input {
    pub name: String,
    pub kind: String,
}

/// Values of a type, the plainest first; those that do not compile are found out by the compiler.
pub fn of(kind: &Type, inputs: &[Input]) -> Vec<String> {
    let text =
        |values: &[&str]| values.iter().map(|value| (*value).to_string()).collect::<Vec<_>>();
    match kind {
        Type::ImplTrait(_) | Type::Never(_) => Vec::new(),
        Type::Paren(kind) => of(&kind.elem, inputs),
        Type::Tuple(tuple) => {
            let parts: Vec<Vec<String>> = tuple.elems.iter().map(|kind| of(kind, inputs)).collect();
            let most = parts.iter().map(Vec::len).max().unwrap_or(1);
            let all = (0..most).map(|k| {
                let part = |values: &Vec<String>| {
                    values
                        .get(k)
                        .or(values.last())
                        .cloned()
                        .unwrap_or("Default::default()".to_string())
                };
                let comma = if parts.len() == 1 { "," } else { "" };
                format!("({}{comma})", parts.iter().map(part).collect::<Vec<_>>().join(", "))
            });
            all.take(2).collect()
        }
        Type::Array(array) => {
            let len = &array.len;
            of(&array.elem, inputs)
                .into_iter()
                .take(1)
                .map(|value| format!("[{value}; {}]", quote::quote!(#len)))
                .collect()
        }
        Type::Reference(reference) => match &*reference.elem {
            Type::Path(path) if path.path.is_ident("str") => text(&["\"\"", "\"mutant\""]),
            Type::Slice(_) => text(&["&[]"]),
            _ => Vec::new(),
        },
        Type::Path(path) => {
            path.path.segments.last().map(|name| named(name, inputs)).unwrap_or_default()
        }
        _ => Vec::new(),
    }
}

fn named(name: &syn::PathSegment, inputs: &[Input]) -> Vec<String> {
    let arguments: Vec<&Type> = match &name.arguments {
        PathArguments::AngleBracketed(arguments) => {
            let kinds = arguments.args.iter().filter_map(|argument| match argument {
                GenericArgument::Type(kind) => Some(kind),
                _ => None,
            });
            kinds.collect()
        }
        _ => Vec::new(),
    };
    let inside = |wrap: &dyn Fn(String) -> String| -> Vec<String> {
        arguments.first().map_or(vec![wrap("()".to_string())], |kind| {
            of(kind, inputs).into_iter().take(2).map(wrap).collect()
        })
    };
    let text =
        |values: &[&str]| values.iter().map(|value| (*value).to_string()).collect::<Vec<_>>();
    let ident = name.ident.to_string();
    match ident.as_str() {
        "bool" => text(&["true", "false"]),
        "f64" => text(&["0.0", "1.0", "-1.0"]),
        "usize" | "u64" | "u32" | "u16" | "u8" | "i32" | "i64" => text(&["0", "1"]),
        "String" => text(&["String::new()"]),
        "Vec" => [text(&["Vec::new()"]), inside(&|value| format!("vec![{value}]"))].concat(),
        "Option" => [text(&["None"]), inside(&|value| format!("Some({value})"))].concat(),
        "Result" => inside(&|value| format!("Ok({value})")),
        _ => {
            let same = inputs.iter().filter(|input| {
                [ident.as_str(), "Self", &format!("&{ident}"), "&Self", "self", "&self"]
                    .contains(&input.kind.as_str())
            });
            let given = same.map(|input| format!("{}.clone()", input.name));
            given.chain(["Default::default()".to_string()]).collect()
        }
    }
}
