//! Stores decimals as the user wrote them, with their nearest f64.

use std::cmp::Ordering;

use super::{Graph, Node, Op};

/// A positive decimal that is not an f64.
#[derive(Clone, PartialEq, Debug)]
pub struct Decimal {
    digits: Digits,
    /// The nearest f64.
    pub nearest: f64,
    /// True if the number is above the nearest f64.
    pub above: bool,
}

/// 0.d₁d₂d₃… · 10ᵉ, without zeros at either end.
#[derive(Clone, PartialEq, Debug)]
struct Digits {
    exponent: i64,
    digits: String,
}

impl Digits {
    /// `12.5e-3`, `1_000`
    fn read(text: &str) -> Option<Digits> {
        let text = text.replace('_', "").to_ascii_lowercase();
        let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let all = format!("{whole}{fraction}");
        if all.is_empty() || !all.bytes().all(|digit| digit.is_ascii_digit()) {
            return None;
        }
        let leading = all.bytes().take_while(|digit| *digit == b'0').count();
        let digits = all[leading..].trim_end_matches('0').to_owned();
        let exponent = if digits.is_empty() {
            0
        } else {
            power.parse::<i64>().ok()?.checked_add(whole.len() as i64 - leading as i64)?
        };
        Some(Digits { exponent, digits })
    }

    /// All digits of a number that is finite and not negative: an f64 has at most 767.
    fn exact(x: f64) -> Option<Digits> {
        Digits::read(&format!("{x:.800e}"))
    }

    fn against(&self, other: &Digits) -> Ordering {
        match (self.digits.is_empty(), other.digits.is_empty()) {
            (false, false) => {
                self.exponent.cmp(&other.exponent).then_with(|| self.digits.cmp(&other.digits))
            }
            (zero, also) => also.cmp(&zero),
        }
    }
}

impl Graph {
    /// Returns the node of a number from the text of a literal, without sign.
    pub fn decimal(&mut self, text: &str) -> Node {
        let nearest = text.replace('_', "").parse().unwrap_or(f64::NAN);
        self.constant_of(text, nearest)
    }

    /// Returns the node of a number with many digits that the f64 `nearest` represents.
    pub fn constant_of(&mut self, text: &str, nearest: f64) -> Node {
        let read = Digits::read(text).filter(|_| nearest.is_finite());
        let Some((digits, exact)) = read.zip(Digits::exact(nearest)) else {
            return self.constant(nearest);
        };
        let order = digits.against(&exact);
        self.rounded |= order != Ordering::Equal;
        if order == Ordering::Equal || !self.as_written {
            return self.constant(nearest);
        }
        let decimal = Decimal { digits, nearest, above: order == Ordering::Greater };
        let known = self.decimals.iter().position(|known| *known == decimal);
        let number = known.unwrap_or_else(|| {
            self.decimals.push(decimal);
            self.decimals.len() - 1
        });
        self.intern(Op::Decimal(number))
    }

    /// Returns a new node for a decimal of which only the nearest f64 and the side of this f64 are
    /// known.
    pub fn decimal_beside(&mut self, nearest: f64, above: bool) -> Node {
        self.decimals.push(Decimal {
            digits: Digits { exponent: 0, digits: String::new() },
            nearest,
            above,
        });
        self.intern(Op::Decimal(self.decimals.len() - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_f64_is_stays_itself() {
        let mut g = Graph::as_written();
        for (text, exact) in [
            ("0.5", true),
            ("2.0", true),
            ("1e22", true),
            ("1_000.25", true),
            ("0.0", true),
            ("00.5e0", true),
            ("1e23", false),
        ] {
            let node = g.decimal(text);
            assert_eq!(g.constant_value(node).is_some(), exact, "{text}");
        }
        let [a, b, c] = ["0.1", "0.10", "0.10000000000000001"].map(|text| g.decimal(text));
        assert!(a == b && a != c);
        let above = |g: &Graph, node| matches!(g.op(node), Op::Decimal(k) if g.decimals[k].above);
        // 0.1 as f64 is 0.1000000000000000055…
        assert_eq!([above(&g, a), above(&g, c)], [false, true]);
        let tiny = g.decimal("1e-400");
        assert!(above(&g, tiny) && g.is_rounded());
        let difference = g.sub(c, a);
        assert!(!g.is_zero(difference));
    }

    #[test]
    fn otherwise_it_is_the_nearest() {
        let mut g = Graph::default();
        let half = g.decimal("0.5");
        let tenth = g.constant(0.1);
        assert!(!g.is_rounded() && g.constant_value(half) == Some(0.5));
        assert!(g.decimal("0.1") == tenth && g.is_rounded());
    }
}
