//! Marks at the ends of expressions, where numbers are looked at that have ceased to be finite.

use proc_macro2::Literal;
use syn::{BinOp, Expr, parse_quote};

use super::{Copy, Rewriter};

impl Rewriter {
    /// The number of an expression that may give something not finite, if ends are marked in this
    /// copy.
    pub(super) fn number_to_mark(&mut self, expression: &Expr) -> Option<usize> {
        let computes = match expression {
            Expr::MethodCall(_) | Expr::Call(_) => true,
            Expr::Binary(binary) => matches!(
                binary.op,
                BinOp::Add(_) | BinOp::Sub(_) | BinOp::Mul(_) | BinOp::Div(_) | BinOp::Rem(_)
            ),
            _ => false,
        };
        let expressions =
            self.expressions.as_mut().filter(|_| computes && self.copy == Copy::Dual)?;
        Some(expressions.number(expression))
    }

    /// `::kin::emitted::ended(number, expression)`. An argument of a call lives as long as the
    /// expression itself would.
    pub(super) fn mark(&self, expression: &mut Expr, number: usize) {
        let dual = &self.dual;
        let number = Literal::usize_unsuffixed(number);
        let mut call: syn::ExprCall = parse_quote!(::kin::emitted::ended::<#dual, _>(#number));
        call.args.push(std::mem::replace(expression, Expr::PLACEHOLDER));
        *expression = Expr::Call(call);
    }
}
