//! Extension module `seismass._kernel`.
