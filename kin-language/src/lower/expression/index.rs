//! Elements and parts of lists by their index.

use super::*;

impl Reader {
    pub(super) fn index(&mut self, index: &syn::ExprIndex) -> Read {
        let base = self.expression(&index.expr)?;
        if let Expr::Range(range) = &*index.index
            && !matches!(base, Value::Opaque(_))
        {
            return self.each(base, &index.expr, &mut |reader, base| match base {
                Value::Array(all) => reader.slice(&all, range),
                value @ (Value::Poison | Value::Never | Value::Left) => Ok(value),
                _ => Err(Unreadable::new(range, "a part of this value")),
            });
        }
        let at = self.expression(&index.index)?;
        self.each_list(
            vec![base, at],
            index,
            &mut |reader, mut both| match (both.pop(), both.pop()) {
                (Some(at), Some(base)) => reader.element_of(base, at, index),
                _ => Ok(Value::Poison),
            },
        )
    }

    fn element_of(&mut self, base: Value, at: Value, index: &syn::ExprIndex) -> Read {
        match (base, at) {
            (Value::Poison, _) | (_, Value::Poison) => Ok(Value::Poison),
            (Value::Left, _) | (_, Value::Left) => Ok(Value::Left),
            (Value::Matrix(n, m), Value::Tuple(pair)) => match pair[..] {
                [Value::Integer(r, _), Value::Integer(c, _)]
                    if (0..n as i64).contains(&r) && (0..n as i64).contains(&c) =>
                {
                    Ok(Value::Scalar(m[r as usize * n + c as usize]))
                }
                [Value::Integer(..), Value::Integer(..)] => Ok(self.mistake(
                    &index.index,
                    format!("a Mat{n} has rows and columns 0 to {}", n - 1),
                )),
                _ => Err(Unreadable::new(&index.index, "an unknown index")),
            },
            (Value::Opaque(base), at) => {
                let at = self.template(at, &index.index)?;
                Ok(Value::Opaque(
                    base.each(&|part| Template::Index(Box::new(part), Box::new(at.clone()))),
                ))
            }
            (Value::Adt(adt), at) => {
                let ty = adt.type_name();
                let arguments = vec![Value::Adt(adt), at];
                match self.own_method(&ty, "index", arguments, index)? {
                    Some(value) => Ok(self.loaded(value)),
                    None => Err(Unreadable::new(&index.index, "an index of a user-defined type")),
                }
            }
            (base, Value::Integer(k, _)) => Ok(self.element(&base, k, index)),
            (base, Value::Opaque(at)) => self.element_at_run_time(&base, at, index),
            (base, at) => Ok(self.mistake(
                &index.index,
                format!("{} cannot be indexed by {}", base.name(), at.name()),
            )),
        }
    }

    /// Reads `all[from..to]`.
    fn slice(&mut self, all: &[Value], range: &syn::ExprRange) -> Read {
        let (from, to) = self.bounds_of(range, all.len())?;
        let part =
            all.get(from..to).ok_or_else(|| Unreadable::new(range, "an index out of range"))?;
        Ok(Value::Array(part.to_vec()))
    }

    /// Returns the first index of a range and the index after its last one.
    pub fn bounds_of(&mut self, range: &syn::ExprRange, length: usize) -> Read<(usize, usize)> {
        let mut bound = |end: &Option<Box<Expr>>, otherwise: usize| match end {
            None => Ok(otherwise),
            Some(end) => match self.expression(end)? {
                Value::Integer(k, _) => {
                    usize::try_from(k).map_err(|_| Unreadable::new(end, "an index out of range"))
                }
                _ => Err(Unreadable::new(end, "an unknown index")),
            },
        };
        let from = bound(&range.start, 0)?;
        let to = bound(&range.end, length)?;
        Ok((
            from,
            if matches!(range.limits, syn::RangeLimits::Closed(_)) && range.end.is_some() {
                to.saturating_add(1)
            } else {
                to
            },
        ))
    }

    fn element(&mut self, base: &Value, k: i64, index: &syn::ExprIndex) -> Value {
        let all: Vec<Value> = match base {
            Value::Array(all) => all.clone(),
            Value::Vector(v) | Value::Euler(v) => v.iter().copied().map(Value::Scalar).collect(),
            other => {
                return self.mistake(&index.expr, format!("{} cannot be indexed", other.name()));
            }
        };
        match usize::try_from(k).ok().and_then(|k| all.get(k)) {
            Some(value) => value.clone(),
            None => self.mistake(
                &index.index,
                format!("index {k} is out of range: the value is {}", base.name()),
            ),
        }
    }

    /// Reads an element of an array by an index that only the running program knows: the value is a
    /// choice among all elements.
    fn element_at_run_time(&mut self, base: &Value, at: Template, index: &syn::ExprIndex) -> Read {
        match base.numbers() {
            Some((nodes, shape)) if !at.has_choice() => {
                let all = Template::Numbers(nodes, shape, crate::lower::first_span(&index.expr));
                Ok(Value::Opaque(Template::Index(Box::new(all), Box::new(at))))
            }
            _ => Err(Unreadable::new(&index.index, "an unknown index")),
        }
    }
}
