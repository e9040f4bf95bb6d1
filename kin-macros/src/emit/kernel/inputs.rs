//! Inputs: numbers of states and rates, time, parameters.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

use super::{Kernel, Numbers};
use kin_graph::Input;

impl Kernel<'_> {
    pub(super) fn input(&mut self, input: Input) -> TokenStream {
        if self.numbers == Numbers::Dual {
            return self.dual_input(input);
        }
        match input {
            Input::Time => quote!(at.t),
            Input::TimeRate => quote!(t_dot),
            Input::Column(_) => quote!(x),
            Input::Parameter(k) => self.lowered.parameters[k].clone(),
            Input::Timed(k) => {
                self.reads_timed = true;
                let k = Literal::usize_unsuffixed(k);
                quote!(timed[#k])
            }
            Input::State(slot, part) => self.reading(slot, part, true).to_token_stream(),
            Input::Rate(slot, part) => self.reading(slot, part, false).to_token_stream(),
        }
    }
}
