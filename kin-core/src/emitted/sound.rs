//! One slip, one message: what rustc finds wrong in the user's own function it does not say again
//! of the copies made of it.
//!
//! A constant that does not compile makes [`If`] an unknown type, and rustc is silent about
//! whatever is made of an unknown type.

/// Marks with `YES` whether something compiles.
pub struct Sound<const YES: bool>;

/// A type that stands only if it does.
pub trait Then {
    /// `T`.
    type Type<T>;
    /// The value itself.
    fn then<T>(value: T) -> Self::Type<T>;
}

impl Then for Sound<true> {
    type Type<T> = T;
    #[inline(always)]
    fn then<T>(value: T) -> T {
        value
    }
}

/// `T`, if the constant `SOUND` compiles.
pub type If<const SOUND: bool, T> = <Sound<SOUND> as Then>::Type<T>;

/// The user's function, if the constant `SOUND` compiles: rustc is silent about calls of something
/// of an unknown type.
#[inline(always)]
pub fn callee<const SOUND: bool, F>(function: F) -> If<SOUND, F>
where
    Sound<SOUND>: Then,
{
    Sound::<SOUND>::then(function)
}
