//! Integers known while the body is read, as rustc would compute them: of the type that they are
//! known to be of.
//!
//! Where the type is not known here (rustc infers it from all uses), an integer is taken as an
//! `i32`, and the difference of two that are not negative as possibly of an unsigned type. What may
//! overflow there is not computed here: the body goes to rustc, which panics or refuses it.

use syn::BinOp;

use super::value::Value;

/// A type of integers: how many bits it has, and whether it is signed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct IntegerType {
    bits: u32,
    signed: bool,
}

impl IntegerType {
    /// The type of that name.
    pub fn named(name: &str) -> Option<Self> {
        let (first, bits) = name.split_at_checked(1)?;
        let signed = match first {
            "i" => true,
            "u" => false,
            _ => return None,
        };
        let bits = match bits {
            "8" => 8,
            "16" => 16,
            "32" => 32,
            // The least that a machine has: what overflows there is not for here.
            "size" => 32,
            "64" | "128" => 63,
            _ => return None,
        };
        Some(IntegerType { bits, signed })
    }

    pub fn is_unsigned(self) -> bool {
        !self.signed
    }

    /// True of a type some of whose values no `f64` is.
    pub fn is_wide(self) -> bool {
        self.bits > 32
    }

    /// Of lengths and indices.
    pub const SIZE: IntegerType = IntegerType { bits: 32, signed: false };

    /// Of what nothing more is known of.
    const DEFAULT: IntegerType = IntegerType { bits: 32, signed: true };

    fn holds(self, value: i64) -> bool {
        match (self.signed, self.bits) {
            (true, 63..) => true,
            (false, 63..) => value >= 0,
            (true, bits) => (-(1_i64 << (bits - 1))..1 << (bits - 1)).contains(&value),
            (false, bits) => (0..1_i64 << bits).contains(&value),
        }
    }
}

/// The type that two integers have in common; `Err` if they have none.
fn common(a: Option<IntegerType>, b: Option<IntegerType>) -> Result<Option<IntegerType>, ()> {
    match (a, b) {
        (Some(a), Some(b)) if a != b => Err(()),
        (a, b) => Ok(a.or(b)),
    }
}

/// `a op b` by i64, if that is what rustc computes; `None` where it may panic, or is not known.
pub fn operate(
    op: &BinOp,
    (a, x): (i64, Option<IntegerType>),
    (b, y): (i64, Option<IntegerType>),
) -> Option<Value> {
    // The amount of a shift may be of any type.
    let shifts = matches!(op, BinOp::Shl(_) | BinOp::Shr(_));
    let ty = if shifts { x } else { common(x, y).ok()? };
    let value = match op {
        BinOp::Add(_) => a.checked_add(b),
        BinOp::Sub(_) => a.checked_sub(b),
        BinOp::Mul(_) => a.checked_mul(b),
        BinOp::Div(_) => a.checked_div(b),
        BinOp::Rem(_) => a.checked_rem(b),
        BinOp::Shl(_) => amount(b, ty).and_then(|n| a.checked_mul(1_i64.checked_shl(n)?)),
        BinOp::Shr(_) => amount(b, ty).and_then(|n| a.checked_shr(n)),
        BinOp::BitAnd(_) => Some(a & b),
        BinOp::BitOr(_) => Some(a | b),
        BinOp::BitXor(_) => Some(a ^ b),
        _ => None,
    };
    made(value?, ty, &[a, b])
}

fn amount(bits: i64, ty: Option<IntegerType>) -> Option<u32> {
    u32::try_from(bits).ok().filter(|n| *n < ty.unwrap_or(IntegerType::DEFAULT).bits)
}

/// An integer made of others, if it is one of its type, as they are.
pub fn made(value: i64, ty: Option<IntegerType>, of: &[i64]) -> Option<Value> {
    let sure = |value: &i64| ty.unwrap_or(IntegerType::DEFAULT).holds(*value);
    // A difference below zero of two that are not may be one of an unsigned type.
    let open = ty.is_none() && value < 0 && of.iter().all(|operand| *operand >= 0);
    (!open && sure(&value) && of.iter().all(sure)).then_some(Value::Integer(value, ty))
}

/// −k, which rustc has of signed types only.
pub fn negated(k: i64, ty: Option<IntegerType>) -> Option<Value> {
    let ty = ty.unwrap_or(IntegerType::DEFAULT);
    k.checked_neg().filter(|value| ty.holds(*value)).map(|value| Value::Integer(value, Some(ty)))
}

/// `k as name` where bits are cut off.
pub fn cut(k: i64, name: &str) -> Option<Value> {
    let value = match name {
        "u8" => i64::from(k as u8),
        "i8" => i64::from(k as i8),
        "u16" => i64::from(k as u16),
        "i16" => i64::from(k as i16),
        "u32" => i64::from(k as u32),
        "i32" => i64::from(k as i32),
        _ => return None,
    };
    Some(Value::Integer(value, IntegerType::named(name)))
}

/// !k, of a type that is known.
pub fn inverted(k: i64, ty: Option<IntegerType>) -> Option<Value> {
    let ty = ty?;
    let value = match (ty.signed, ty.bits) {
        (true, _) => !k,
        (false, bits) if bits < 32 => (1_i64 << bits) - 1 - k,
        _ => return None,
    };
    Some(Value::Integer(value, Some(ty)))
}

/// The same integer as one of a type; `None` if it is none, or is known to be of another.
pub fn typed(k: i64, known: Option<IntegerType>, ty: IntegerType) -> Option<Value> {
    (common(known, Some(ty)).is_ok() && ty.holds(k)).then_some(Value::Integer(k, Some(ty)))
}
