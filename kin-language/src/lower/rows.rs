//! From the value of the body to named rows.

use quote::ToTokens;
use syn::{Block, Expr, Stmt};

use crate::lower::values::{Value, Values};
use crate::parse::{ConstraintFn, Role, Shape};
use kin_graph::Node;

/// One equation.
pub struct Row {
    pub name: String,
    pub node: Node,
}

impl Values {
    /// Returns the rows of the constraint. A value that differs from the signature or depends on no
    /// coordinate is a mistake.
    pub fn rows(&mut self, source: &ConstraintFn, value: &Value) -> Vec<Row> {
        let tail = tail(&source.body);
        let at: &dyn ToTokens = match tail {
            Some(tail) => tail,
            None => &source.output_type,
        };
        if let Value::Tuple(all) = value
            && all.is_empty()
            && source.output != Shape::Tuple(vec![])
        {
            let text = "the function ends without a value: end the function with the expression of the equation, without `;`";
            match source.body.stmts.last() {
                Some(last) => self.mistake(last, text),
                None => self.mistake(
                    &source.output_type,
                    "the function is empty: end the function with the expression of the equation",
                ),
            };
            return vec![];
        }
        let Some(parts) = self.parts(source, value, tail, at) else { return vec![] };
        let shapes: Vec<(usize, &Shape)> =
            parts.iter().map(|(nodes, shape)| (nodes.len(), shape)).collect();
        let names = row_names(&source.output, tail, &shapes);
        let rows: Vec<Row> = names
            .into_iter()
            .zip(parts.iter().flat_map(|p| &p.0))
            .map(|(name, &node)| Row { name, node })
            .collect();
        self.refuse_constants(source, &parts, tail, &rows);
        rows
    }

    /// Returns the numbers of each element of the returned tuple or array, or of a single value.
    fn parts(
        &mut self,
        source: &ConstraintFn,
        value: &Value,
        tail: Option<&Expr>,
        at: &dyn ToTokens,
    ) -> Option<Vec<(Vec<Node>, Shape)>> {
        let (values, shapes): (Vec<Value>, Vec<Shape>) = match (value, &source.output) {
            (Value::Tuple(all), Shape::Tuple(shapes)) if all.len() == shapes.len() => {
                (all.clone(), shapes.clone())
            }
            (Value::Array(all), Shape::Array(inner, n)) if all.len() == *n => {
                (all.clone(), vec![(**inner).clone(); *n])
            }
            (value, shape) => (vec![value.clone()], vec![shape.clone()]),
        };
        let places = elements(tail, values.len());
        let mut parts = Vec::new();
        for ((value, shape), place) in values.into_iter().zip(shapes).zip(places) {
            let at = place.map_or(at, |place| place as &dyn ToTokens);
            let value = match (value, shape) {
                (Value::Opaque(template), Shape::Any) => {
                    self.shaped(Value::Opaque(template), &Shape::Scalar, at)
                }
                (value, shape) => self.shaped(value, &shape, at),
            };
            parts.push(value.numbers()?);
        }
        Some(parts)
    }

    /// Refuses an equation that depends on no coordinate, since it cannot determine one.
    fn refuse_constants(
        &mut self,
        source: &ConstraintFn,
        parts: &[(Vec<Node>, Shape)],
        tail: Option<&Expr>,
        rows: &[Row],
    ) {
        // A force may depend on time alone.
        if !self.mistakes.is_empty() || source.role == Role::Force {
            return;
        }
        let mut row = rows.iter();
        let places = elements(tail, parts.len());
        for (part, place) in parts.iter().zip(places) {
            let constant: Vec<&str> = row
                .by_ref()
                .take(part.0.len())
                .filter(|row| !self.graph.depends(row.node).on_q)
                .map(|row| row.name.as_str())
                .collect();
            if constant.is_empty() {
                continue;
            }
            let which = if rows.len() == 1 {
                "this equation".into()
            } else {
                format!("row `{}`", constant.join("`, `"))
            };
            let text = format!(
                "{which} depends on no coordinate, so Kin cannot use this equation: use a body or a `Coord` in the equation{}",
                alias_cure(source)
            );
            match place.or(tail) {
                Some(place) => self.mistake(place, text),
                None => self.mistake(&source.name, text),
            };
        }
    }
}

/// Returns a cure for a parameter of an unknown type that may be an alias of a coordinate.
fn alias_cure(source: &ConstraintFn) -> String {
    let other = source.arguments.iter().find(|a| a.kind == crate::parse::Kind::Other);
    other.map_or(String::new(), |a| {
        format!(
            " (`{}: {}` is a parameter here, because Kin reads types by name, not through aliases)",
            a.name,
            a.ty.to_token_stream()
        )
    })
}

/// Returns the expression whose value the function returns.
fn tail(body: &Block) -> Option<&Expr> {
    match body.stmts.last()? {
        Stmt::Expr(Expr::Return(last), _) => last.expr.as_deref(),
        Stmt::Expr(Expr::Block(block), None) => tail(&block.block),
        Stmt::Expr(expression, None) => Some(expression),
        _ => None,
    }
}

/// Returns the expressions of the elements, if the last expression is a literal tuple or array of
/// `n`.
fn elements(tail: Option<&Expr>, n: usize) -> Vec<Option<&Expr>> {
    let all: Vec<&Expr> = match tail {
        Some(Expr::Tuple(tuple)) => tuple.elems.iter().collect(),
        Some(Expr::Array(array)) => array.elems.iter().collect(),
        _ => vec![],
    };
    if all.len() == n { all.into_iter().map(Some).collect() } else { vec![None; n] }
}

/// Returns the names of the rows on the dual route, which knows only the signature and the last
/// expression.
pub fn names_as_written(source: &ConstraintFn) -> Vec<String> {
    let any = |shape: &Shape| if *shape == Shape::Any { 1 } else { shape.count() };
    let shapes: Vec<(usize, &Shape)> = match &source.output {
        Shape::Tuple(all) => all.iter().map(|shape| (any(shape), shape)).collect(),
        Shape::Array(inner, n) => vec![(any(inner), inner); *n],
        shape => vec![(any(shape), shape)],
    };
    row_names(&source.output, tail(&source.body), &shapes)
}

/// Names of the rows: identifiers of a returned tuple or array, else x, y, z of a vector, else
/// numbers from
/// 1. `parts` are the numbers of rows and the shapes of its elements.
fn row_names(output: &Shape, tail: Option<&Expr>, parts: &[(usize, &Shape)]) -> Vec<String> {
    const AXES: [&str; 3] = ["x", "y", "z"];
    if let (Shape::Vector(n), [_]) = (output, parts) {
        return AXES[..*n].iter().map(ToString::to_string).collect();
    }
    let mut names = Vec::new();
    for ((rows, shape), place) in parts.iter().zip(elements(tail, parts.len())) {
        let name = place.and_then(|place| match place {
            Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
            _ => None,
        });
        for k in 0..*rows {
            names.push(match (&name, shape) {
                (Some(name), Shape::Scalar) => name.clone(),
                (Some(name), Shape::Any) if *rows == 1 => name.clone(),
                (Some(name), Shape::Vector(_)) => format!("{name}.{}", AXES.get(k).unwrap_or(&"?")),
                (Some(name), _) => format!("{name}.{}", k + 1),
                (None, _) => (names.len() + 1).to_string(),
            });
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use quote::quote;

    fn names(item: proc_macro2::TokenStream) -> Vec<String> {
        let source = crate::parse::constraint(quote!(), item).unwrap_or_else(|e| panic!("{e}"));
        match super::super::constraint(&source) {
            Ok(lowered) => lowered.rows.into_iter().map(|row| row.name).collect(),
            Err(_) => panic!("the body cannot be read"),
        }
    }

    #[test]
    fn rows_are_named_after_what_is_returned() {
        assert_eq!(
            names(quote!(
                fn f(i: Planar) -> Vec2 {
                    i.r
                }
            )),
            ["x", "y"]
        );
        assert_eq!(
            names(quote!(
                fn f(i: Planar) -> f64 {
                    i.theta
                }
            )),
            ["1"]
        );
        assert_eq!(
            names(quote!(
                fn f(i: Planar) -> (Vec2, f64) {
                    let d = i.r;
                    let turn = i.theta;
                    (d, turn)
                }
            )),
            ["d.x", "d.y", "turn"]
        );
        assert_eq!(
            names(quote!(
                fn f(i: Planar) -> [f64; 2] {
                    [i.r.x, i.theta * 2.0]
                }
            )),
            ["1", "2"]
        );
        assert_eq!(
            names(quote!(
                fn f(a: Coord, b: Coord) -> [_; 2] {
                    let gap = a - b;
                    return [gap, a];
                }
            )),
            ["gap", "a"]
        );
    }
}
