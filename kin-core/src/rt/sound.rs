//! One slip, one message: what rustc finds wrong in the user's own function it does not say again of the copies made of it.
//!
//! A constant that does not compile makes [`If`] an unknown type, and rustc is silent about whatever is made of an unknown type.

/// Whether something compiles.
pub struct Sound<const YES: bool>;

/// A type that stands only if it does.
pub trait Then {
    /// `T`.
    type Type<T>;
}

impl Then for Sound<true> {
    type Type<T> = T;
}

/// `T`, if the constant `SOUND` compiles.
pub type If<const SOUND: bool, T> = <Sound<SOUND> as Then>::Type<T>;
