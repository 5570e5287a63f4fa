//! The instructions the hot loops may use.

use std::sync::OnceLock;

/// Instructions the hot loops are compiled for. Each gives the same bits on every machine; the baseline and the others agree
/// to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InstructionSet {
    /// What every machine of the architecture has.
    Baseline,
    /// 256-bit vectors and fused multiply-add (x86-64-v3).
    Avx2,
    /// The same with twice the registers (x86-64-v4): the same bits.
    Avx512,
}

impl InstructionSet {
    /// The one in use: the widest this machine has, or what the environment variable `SEISMASS_INSTRUCTIONS`
    /// (`baseline`, `avx2`, `avx512`) names. Where the machine does not have that, or it is no such name, it is the baseline,
    /// and a line on standard error says so. Read once.
    #[inline]
    pub fn in_use() -> Self {
        static CHOSEN: OnceLock<InstructionSet> = OnceLock::new();
        *CHOSEN.get_or_init(|| {
            let wanted = std::env::var("SEISMASS_INSTRUCTIONS").unwrap_or_default();
            let chosen = [Self::Avx512, Self::Avx2]
                .into_iter()
                .find(|set| set.is_available() && (wanted.is_empty() || wanted == set.name()))
                .unwrap_or(Self::Baseline);
            if !wanted.is_empty() && wanted != chosen.name() {
                let known = [Self::Avx512, Self::Avx2].iter().any(|set| wanted == set.name());
                let reason = if known { "which this machine does not have" } else { "not baseline, avx2 or avx512" };
                eprintln!("seismass: SEISMASS_INSTRUCTIONS is {wanted:?}, {reason}: the baseline is used");
            }
            chosen
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

/// Defines a function of which each path is compiled for its instructions: `inner`, generic in the vector and in the
/// constants in brackets, if there are any.
macro_rules! for_each_path {
    ($(#[$meta:meta])* $vis:vis fn $name:ident $([$($constant:ident: $of:ty),*])? ($($arg:ident: $type:ty),* $(,)?)
        $(-> $out:ty)? = $inner:ident) => {
        $(#[$meta])*
        #[allow(unsafe_code)]
        $vis fn $name $(<$(const $constant: $of),*>)? ($($arg: $type),*) $(-> $out)? {
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,fma,avx512f,avx512vl")]
            fn avx512 $(<$(const $constant: $of),*>)? ($($arg: $type),*) $(-> $out)? {
                $inner::<crate::lanes::x86::Fused $($(, $constant)*)?>($($arg),*)
            }
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,fma")]
            fn avx2 $(<$(const $constant: $of),*>)? ($($arg: $type),*) $(-> $out)? {
                $inner::<crate::lanes::x86::Fused $($(, $constant)*)?>($($arg),*)
            }
            match crate::lanes::instructions::InstructionSet::in_use() {
                // SAFETY: `in_use` returns only what this machine has.
                #[cfg(target_arch = "x86_64")]
                crate::lanes::instructions::InstructionSet::Avx512 => unsafe { avx512 $(::<$($constant),*>)? ($($arg),*) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                crate::lanes::instructions::InstructionSet::Avx2 => unsafe { avx2 $(::<$($constant),*>)? ($($arg),*) },
                _ => $inner::<crate::lanes::plain::Plain $($(, $constant)*)?>($($arg),*),
            }
        }
    };
}

pub(crate) use for_each_path;
