//! Numbers of several elements side by side: what a kernel does to one, it does to all lanes at once.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Elements that a kernel works on at once; eight `f32` fill a register of AVX.
pub(super) const LANES: usize = 8;

/// The precision of a kernel.
pub(super) trait Scalar:
    Copy
    + Default
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + Send
    + Sync
    + 'static
{
    fn of(value: f64) -> Self;
}

impl Scalar for f32 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value as Self
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
}

/// One number of each of the elements.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(32))]
pub(super) struct Lanes<T>(pub(super) [T; LANES]);

impl<T: Scalar> Lanes<T> {
    #[inline(always)]
    pub(super) fn splat(value: f64) -> Self {
        Self([T::of(value); LANES])
    }

    #[inline(always)]
    pub(super) fn map(self, f: impl Fn(T) -> T) -> Self {
        Self(self.0.map(f))
    }

    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        let mut result = self;
        for (value, other) in result.0.iter_mut().zip(other.0) {
            *value = f(*value, other);
        }
        result
    }
}

impl<T: Scalar> Default for Lanes<T> {
    #[inline(always)]
    fn default() -> Self {
        Self([T::default(); LANES])
    }
}

impl<T: Scalar> Add for Lanes<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<T: Scalar> Sub for Lanes<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<T: Scalar> Mul for Lanes<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<T: Scalar> Div for Lanes<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl<T: Scalar> Neg for Lanes<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|value| -value)
    }
}

impl<T: Scalar> AddAssign for Lanes<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// A vector of each of the elements.
pub(super) type Vector<T> = [Lanes<T>; 3];

/// A matrix of each of the elements, as its columns.
pub(super) type Columns<T> = [Vector<T>; 3];

#[inline(always)]
pub(super) fn dot<T: Scalar>(a: &Vector<T>, b: &Vector<T>) -> Lanes<T> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross<T: Scalar>(a: &Vector<T>, b: &Vector<T>) -> Vector<T> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub(super) fn plus<T: Scalar>(a: &Vector<T>, b: &Vector<T>) -> Vector<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(super) fn scaled<T: Scalar>(a: &Vector<T>, factor: Lanes<T>) -> Vector<T> {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// Sum of the products of all entries, A : B.
#[inline(always)]
pub(super) fn contraction<T: Scalar>(a: &Columns<T>, b: &Columns<T>) -> Lanes<T> {
    dot(&a[0], &b[0]) + dot(&a[1], &b[1]) + dot(&a[2], &b[2])
}

/// ∂ det A/∂A.
#[inline(always)]
pub(super) fn cofactors<T: Scalar>(a: &Columns<T>) -> Columns<T> {
    [
        cross(&a[1], &a[2]),
        cross(&a[2], &a[0]),
        cross(&a[0], &a[1]),
    ]
}

/// A v.
#[inline(always)]
pub(super) fn times<T: Scalar>(a: &Columns<T>, v: &Vector<T>) -> Vector<T> {
    let mut result = scaled(&a[0], v[0]);
    for column in 1..3 {
        for row in 0..3 {
            result[row] += a[column][row] * v[column];
        }
    }
    result
}

/// Aᵀ B.
#[inline(always)]
pub(super) fn transposed_times<T: Scalar>(a: &Columns<T>, b: &Columns<T>) -> Columns<T> {
    let mut result = Columns::default();
    for (column, b) in result.iter_mut().zip(b) {
        for (entry, a) in column.iter_mut().zip(a) {
            *entry = dot(a, b);
        }
    }
    result
}

/// A B.
#[inline(always)]
pub(super) fn product<T: Scalar>(a: &Columns<T>, b: &Columns<T>) -> Columns<T> {
    [times(a, &b[0]), times(a, &b[1]), times(a, &b[2])]
}
