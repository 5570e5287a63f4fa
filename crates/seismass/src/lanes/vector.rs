//! Four numbers at once.

/// Lanes of a vector.
pub(crate) const WIDTH: usize = 4;

/// All lanes of a vector, as bits.
pub(crate) const ALL_LANES: u32 = (1 << WIDTH) - 1;

/// Four lanes.
pub(crate) trait Vector: Copy {
    fn splat(value: f64) -> Self;
    fn load(values: &[f64; WIDTH]) -> Self;
    /// From numbers that are not in memory yet: to put them there and load them at once would wait for each.
    fn of(values: [f64; WIDTH]) -> Self;
    fn store(self, values: &mut [f64; WIDTH]);
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    /// self * factor + term, fused where the path has it.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    fn abs(self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    /// One lane in all.
    fn broadcast(self, lane: usize) -> Self;
    /// Each lane takes that below it, the lowest takes the highest of `before`.
    fn shifted_up(self, before: Self) -> Self;
    /// Each lane takes that above it, the highest takes the lowest of `after`.
    fn shifted_down(self, after: Self) -> Self;
    /// The same with the lanes of `other` of which the bits are set.
    fn with(self, bits: u32, other: Self) -> Self;
    /// The same with a number in one lane. What is made so can be stored and read again at once.
    fn with_lane(self, lane: usize, value: f64) -> Self;
    /// Lane j of vector i becomes lane i of vector j.
    fn transposed(vectors: [Self; WIDTH]) -> [Self; WIDTH];
    /// Bits of the lanes that are not below those of `other`; lanes that are no numbers are not.
    fn not_below(self, other: Self) -> u32;
    /// Marks of `before`, and of the lanes that are not below those of `other`, lanes that are no numbers among them.
    fn mark_not_below(self, other: Self, before: Self) -> Self;
    /// Whether a lane is marked: its sign is.
    fn has_marks(self) -> bool;
    fn sum(self) -> f64;
    /// The same sum in every lane.
    fn total(self) -> Self;
    /// a * b + c of numbers, fused where the path has it.
    fn fused(a: f64, b: f64, c: f64) -> f64;
}
