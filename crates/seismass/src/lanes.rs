//! Storeys as lanes of fixed-size arrays, of which the compiler makes vectors, and the instructions it may use for them.

use std::sync::OnceLock;

/// Instructions the hot loops are compiled for. Paths agree to rounding; each gives the same bits everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InstructionSet {
    /// What every machine of the architecture has.
    Baseline,
    /// 256-bit vectors and fused multiply-add (x86-64-v3).
    Avx2,
    /// 512-bit vectors and fused multiply-add (x86-64-v4).
    Avx512,
}

impl InstructionSet {
    /// The one in use: the widest this machine has, or what the environment variable `SEISMASS_INSTRUCTIONS`
    /// (`baseline`, `avx2`, `avx512`) names if the machine has it. Read once.
    pub fn in_use() -> Self {
        static CHOSEN: OnceLock<InstructionSet> = OnceLock::new();
        *CHOSEN.get_or_init(|| {
            let wanted = std::env::var("SEISMASS_INSTRUCTIONS").unwrap_or_default();
            [Self::Avx512, Self::Avx2]
                .into_iter()
                .find(|set| set.is_available() && (wanted.is_empty() || wanted == set.name()))
                .unwrap_or(Self::Baseline)
        })
    }

    /// Lower-case name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    #[cfg(target_arch = "x86_64")]
    fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            Self::Avx512 => {
                Self::Avx2.is_available() && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl")
            }
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn is_available(self) -> bool {
        self == Self::Baseline
    }
}

/// Most storeys that the lanes hold.
pub(crate) const MAX_LANES: usize = 48;

/// Storeys padded to whole vectors.
pub(crate) fn padded(storeys: usize) -> usize {
    match storeys {
        0..=4 => 4,
        5..=8 => 8,
        9..=16 => 16,
        17..=MAX_LANES => MAX_LANES,
        _ => storeys.next_multiple_of(8),
    }
}

/// a b + c, fused or not.
#[inline(always)]
pub(crate) fn multiply_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// The first `N` values as lanes; zeros where there are fewer.
#[inline(always)]
pub(crate) fn first_lanes<const N: usize>(values: &[f64]) -> [f64; N] {
    values.first_chunk::<N>().copied().unwrap_or([0.0; N])
}
