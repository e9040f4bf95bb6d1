//! Operations as they are written.

use super::*;

impl Kernel<'_> {
    pub(super) fn written(&mut self, node: Node) -> TokenStream {
        match self.graph().op(node) {
            Op::Input(input) => self.input(input),
            Op::Constant(bits) => self.constant(f64::from_bits(bits)),
            Op::Decimal(k) => self.constant(self.graph().decimals[k].nearest),
            Op::Truth(value) => quote!(#value),
            Op::Add(a, b) => self.infix(a, quote!(+), b),
            Op::Sub(a, b) => self.infix(a, quote!(-), b),
            Op::Mul(a, b) => self.infix(a, quote!(*), b),
            Op::Div(a, b) => self.infix(a, quote!(/), b),
            Op::Fma(a, b, c) => {
                self.fused = true;
                let fma = super::super::own("fma");
                let a = self.expression(a);
                let b = self.expression(b);
                let c = self.expression(c);
                quote!(#fma(#a, #b, #c))
            }
            Op::And(a, b) => self.infix(a, quote!(&&), b),
            Op::Or(a, b) => self.infix(a, quote!(||), b),
            Op::Compare(comparison, a, b) => self.infix(a, sign(comparison), b),
            Op::Neg(a) => {
                let a = self.operand(a);
                quote!(-#a)
            }
            Op::Not(a) => {
                let a = self.operand(a);
                quote!(!#a)
            }
            Op::Call(f, a) => self.function(f.method(), &[a]),
            Op::Call2(Function2::Rem, a, b) => self.infix(a, quote!(%), b),
            Op::Call2(f, a, b) => self.function(f.method(), &[a, b]),
            Op::Powi(a, n) => {
                let of = self.functions_of();
                let a = self.expression(a);
                let n = Literal::i32_unsuffixed(n);
                quote!(#of::powi(#a, #n))
            }
            Op::Select(c, a, b) => {
                let c = self.expression(c);
                let a = self.expression(a);
                let b = self.expression(b);
                quote!(if #c { #a } else { #b })
            }
            // These have names before they are written.
            Op::Law(..) | Op::Opaque(..) | Op::Leaf(_) => quote!(f64::NAN),
        }
    }

    pub(super) fn constant(&self, value: f64) -> TokenStream {
        let value = number(value);
        match self.numbers {
            Numbers::Plain => value,
            Numbers::Dual => quote!(::kin::emitted::Real::<__D>::from(#value)),
        }
    }

    /// Where the functions of the numbers are.
    pub(super) fn functions_of(&self) -> TokenStream {
        match self.numbers {
            Numbers::Plain => quote!(::kin::emitted::math),
            Numbers::Dual => quote!(<::kin::emitted::Real<__D>>),
        }
    }

    /// A function of the numbers' type.
    pub(super) fn function(&mut self, name: &str, arguments: &[Node]) -> TokenStream {
        let of = self.functions_of();
        let name = Ident::new(name, Span::call_site());
        let arguments: Vec<TokenStream> = arguments.iter().map(|&n| self.expression(n)).collect();
        quote!(#of::#name(#(#arguments),*))
    }

    pub(super) fn infix(&mut self, a: Node, sign: TokenStream, b: Node) -> TokenStream {
        let a = self.operand(a);
        let b = self.operand(b);
        quote!(#a #sign #b)
    }
}
