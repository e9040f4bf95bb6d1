//! Integers that are known during the reading, computed as rustc would compute them in their type.
//!
//! If the type is not known here (rustc infers it from all uses), an integer counts as an `i32`,
//! and a negative difference of two integers that are not negative may have an unsigned type. The
//! interpreter does not compute an operation that may overflow: the body then goes to rustc, which
//! panics or refuses it.

use syn::BinOp;

use super::Value;

/// A type of integers: its number of bits, and its sign.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct IntegerType {
    bits: u32,
    signed: bool,
}

impl IntegerType {
    /// Returns the type with this name.
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
            // The least width that a machine has: the interpreter does not compute what overflows
            // there.
            "size" => 32,
            "64" | "128" => 63,
            _ => return None,
        };
        Some(IntegerType { bits, signed })
    }

    pub fn is_unsigned(self) -> bool {
        !self.signed
    }

    /// Returns true for a type with values that `f64` does not have.
    pub fn is_wide(self) -> bool {
        self.bits > 32
    }

    /// The type of lengths and indices.
    pub const SIZE: IntegerType = IntegerType { bits: 32, signed: false };

    /// The type of an integer about which nothing else is known.
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

/// Returns the common type of two integers, or `Err` if they have none.
fn common(a: Option<IntegerType>, b: Option<IntegerType>) -> Result<Option<IntegerType>, ()> {
    match (a, b) {
        (Some(a), Some(b)) if a != b => Err(()),
        (a, b) => Ok(a.or(b)),
    }
}

/// Returns `a op b`, or `None` if the operation may panic or its result is not known here.
pub fn operate(
    op: &BinOp,
    (a, x): (i64, Option<IntegerType>),
    (b, y): (i64, Option<IntegerType>),
) -> Option<Value> {
    // The amount of a shift may have any integer type.
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

/// Returns an integer computed from the operands `of`, or `None` if the result or an operand may
/// lie outside its type.
pub fn made(value: i64, ty: Option<IntegerType>, of: &[i64]) -> Option<Value> {
    let sure = |value: &i64| ty.unwrap_or(IntegerType::DEFAULT).holds(*value);
    // A negative difference of two integers that are not negative may have an unsigned type.
    let open = ty.is_none() && value < 0 && of.iter().all(|operand| *operand >= 0);
    (!open && sure(&value) && of.iter().all(sure)).then_some(Value::Integer(value, ty))
}

/// Returns −k, which exists for signed types only.
pub fn negated(k: i64, ty: Option<IntegerType>) -> Option<Value> {
    let ty = ty.unwrap_or(IntegerType::DEFAULT);
    k.checked_neg().filter(|value| ty.holds(*value)).map(|value| Value::Integer(value, Some(ty)))
}

/// Returns `k as name` for a type that may cut off bits.
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

/// Returns !k for a known type.
pub fn inverted(k: i64, ty: Option<IntegerType>) -> Option<Value> {
    let ty = ty?;
    let value = match (ty.signed, ty.bits) {
        (true, _) => !k,
        (false, bits) if bits < 32 => (1_i64 << bits) - 1 - k,
        _ => return None,
    };
    Some(Value::Integer(value, Some(ty)))
}

/// Returns the integer with a declared type, or `None` if it does not fit or is known to have
/// another type.
pub fn typed(k: i64, known: Option<IntegerType>, ty: IntegerType) -> Option<Value> {
    (common(known, Some(ty)).is_ok() && ty.holds(k)).then_some(Value::Integer(k, Some(ty)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_operation_that_may_overflow_is_not_computed() {
        let byte = IntegerType::named("u8");
        let sum = |a, b, ty| operate(&syn::parse_quote!(+), (a, ty), (b, ty));
        assert!(matches!(sum(200, 55, byte), Some(Value::Integer(255, _))));
        assert!(sum(200, 56, byte).is_none());
        let less = operate(&syn::parse_quote!(-), (1, None), (2, None));
        assert!(less.is_none(), "the type may be unsigned");
        assert!(matches!(cut(257, "u8"), Some(Value::Integer(1, _))));
    }
}
