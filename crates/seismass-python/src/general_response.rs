//! The response of the general engine as arrays. What storeys and floors have has the names of `Response`; levels of racks
//! come after each other, rack by rack.

use pyo3::prelude::*;
use seismass::GeneralStatus;

use crate::arrays::{Named, Output};
use crate::general_run::{GeneralResponse, values};
use crate::response::{instruction_set, statistics};

getters! { GeneralResponse
    /// "completed" or "collapsed".
    status(self) -> &'static str = match self.0.status {
        GeneralStatus::Completed => "completed",
        GeneralStatus::Collapsed { .. } => "collapsed",
    };
    /// Time reached (s).
    end_time(self) -> f64 = self.0.end_time;
    /// Storey that collapsed, counted from 1; levels of racks count on.
    collapsed_storey(self) -> Option<usize> = match self.0.status {
        GeneralStatus::Completed => None,
        GeneralStatus::Collapsed { number, .. } => Some(number),
    };
    /// Number of levels of each rack.
    rack_levels(self) -> Vec<usize> = self.0.levels.clone();
    /// Peak storey drift (m).
    peak_drift(self) -> Output<f64> = self.peaks(&self.0.peaks.drift, false);
    /// Time of the peak drift (s).
    peak_drift_time(self) -> Output<f64> = self.times(&self.0.peaks.drift, false);
    /// Peak drift of rack levels (m).
    peak_rack_drift(self) -> Output<f64> = self.peaks(&self.0.peaks.drift, true);
    /// Time of the peak drift of rack levels (s).
    peak_rack_drift_time(self) -> Output<f64> = self.times(&self.0.peaks.drift, true);
    /// Peak slip of each block (m).
    peak_slip(self) -> Output<f64> = values(&self.0.peaks.slip);
    /// Time of the peak slip (s).
    peak_slip_time(self) -> Output<f64> = Output::new(self.0.peaks.slip.iter().map(|peak| peak.time));
    /// Peak force of each block on its stop (N).
    peak_contact_force(self) -> Output<f64> = values(&self.0.peaks.contact_force);
    /// Peak relative velocity at which each block comes to its stop (m/s).
    peak_contact_velocity(self) -> Output<f64> = values(&self.0.peaks.contact_velocity);
    /// Peak absolute floor acceleration (m/s2).
    peak_floor_acceleration(self) -> Output<f64> = self.peaks(&self.0.peaks.acceleration, false);
    /// Time of the peak floor acceleration (s).
    peak_floor_acceleration_time(self) -> Output<f64> = self.times(&self.0.peaks.acceleration, false);
    /// Peak absolute acceleration of rack levels (m/s2).
    peak_rack_acceleration(self) -> Output<f64> = self.peaks(&self.0.peaks.acceleration, true);
    /// Peak storey shear, the spring force alone (N).
    peak_storey_shear(self) -> Output<f64> = self.peaks(&self.0.peaks.shear, false);
    /// Time of the peak storey shear (s).
    peak_storey_shear_time(self) -> Output<f64> = self.times(&self.0.peaks.shear, false);
    /// Peak shear of rack levels, the spring force alone (N).
    peak_rack_shear(self) -> Output<f64> = self.peaks(&self.0.peaks.shear, true);
    /// Peak of the spring force of storey 1 and the matrix's share of the base shear together (N).
    peak_base_shear(self) -> f64 = if self.0.storeys > 0 { self.0.peaks.base_shear.value } else { f64::NAN };
    /// Drift at the end (m).
    residual_drift(self) -> Output<f64> = Output::new(self.part(&self.0.residual_drift, false));
    /// Drift of rack levels at the end (m).
    residual_rack_drift(self) -> Output<f64> = Output::new(self.part(&self.0.residual_drift, true));
    /// Slip at the end (m).
    residual_slip(self) -> Output<f64> = Output::new(self.0.residual_slip.iter().copied());
    /// Path slipped in contact with what carries the block (m).
    slip_path(self) -> Output<f64> = Output::new(self.0.slip_path.iter().copied());
    /// Peak slip of a sliding base (m).
    peak_base_slip(self) -> Option<f64> = self.0.base.as_ref().map(|base| base.slip.value);
    /// Time of the peak slip of a sliding base (s).
    peak_base_slip_time(self) -> Option<f64> = self.0.base.as_ref().map(|base| base.slip.time);
    /// Peak absolute acceleration of the slab of a sliding base (m/s2).
    peak_base_acceleration(self) -> Option<f64> = self.0.base.as_ref().map(|base| base.acceleration.value);
    /// Slip of a sliding base at the end (m).
    residual_base_slip(self) -> Option<f64> = self.0.base.as_ref().map(|base| base.residual_slip);
    /// Path slipped by a sliding base in contact with the ground (m).
    base_slip_path(self) -> Option<f64> = self.0.base.as_ref().map(|base| base.slip_path);
    /// History of the slip of a sliding base (m), one value per row.
    base_slip(self) -> Option<Output<f64>> = self.of_base(|base| &base.history);
    /// History of the velocity of a sliding base over the ground (m/s), one value per row.
    base_velocity(self) -> Option<Output<f64>> = self.of_base(|base| &base.velocity_history);
    /// History of the absolute acceleration of a sliding base (m/s2), one value per row.
    base_acceleration(self) -> Option<Output<f64>> = self.of_base(|base| &base.acceleration_history);
    /// Samples per row of the histories; None without histories.
    every(self) -> Option<usize> = self.0.histories.as_ref().map(|histories| histories.every);
    /// Drift history (m), rows x storeys.
    drift(self) -> Option<Output<f64>> = self.history(|h| &h.drift, false);
    /// Drift history of rack levels (m), rows x levels.
    rack_drift(self) -> Option<Output<f64>> = self.history(|h| &h.drift, true);
    /// Slip history (m), rows x blocks.
    slip(self) -> Option<Output<f64>> = self.of_blocks(|h| &h.slip);
    /// Floor velocity relative to the ground (m/s), rows x storeys.
    floor_velocity(self) -> Option<Output<f64>> = self.history(|h| &h.floor_velocity, false);
    /// Velocity of rack levels relative to the ground (m/s), rows x levels.
    rack_velocity(self) -> Option<Output<f64>> = self.history(|h| &h.floor_velocity, true);
    /// Block velocity relative to the ground (m/s), rows x blocks.
    block_velocity(self) -> Option<Output<f64>> = self.of_blocks(|h| &h.block_velocity);
    /// Absolute floor acceleration (m/s2), rows x storeys.
    floor_acceleration(self) -> Option<Output<f64>> = self.history(|h| &h.floor_acceleration, false);
    /// Absolute acceleration of rack levels (m/s2), rows x levels.
    rack_acceleration(self) -> Option<Output<f64>> = self.history(|h| &h.floor_acceleration, true);
    /// Spring force (N), rows x storeys.
    storey_force(self) -> Option<Output<f64>> = self.history(|h| &h.storey_force, false);
    /// Spring force of rack levels (N), rows x levels.
    rack_force(self) -> Option<Output<f64>> = self.history(|h| &h.storey_force, true);
    /// Times of the events (s).
    event_time(self) -> Option<Output<f64>> = self.event_column(|entry| entry.event.time);
    /// Kinds of the events, as indices of `Response.event_kinds`.
    event_kind(self) -> Option<Output<u8>> = self.event_column(|entry| entry.event.kind as u8);
    /// Storey (levels of racks count on) or block of each event, counted from 1; 0 for a sliding base.
    event_number(self) -> Option<Output<u32>> = self.event_column(|entry| u32::try_from(entry.event.number).unwrap_or(u32::MAX));
    /// Sign of each event.
    event_sign(self) -> Option<Output<i8>> = self.event_column(|entry| entry.event.sign);
    /// Segments of the backbone left at each yield, 1 at the first; stage of wear that begins; otherwise 0.
    event_element(self) -> Option<Output<u8>> = self.event_column(|entry| entry.event.element);
    /// Relative velocity of a block that comes to its stop or leaves it, wears, lifts or lands (m/s); otherwise 0.
    event_velocity(self) -> Option<Output<f64>> = self.event_column(|entry| entry.velocity);
    /// Number of events of each kind, in the order of `Response.event_kinds`.
    event_counts(self) -> Vec<usize> = self.0.statistics.events.0.to_vec();
    /// Energies (J) and their relative residual, if asked for.
    energy(self) -> Option<Named<f64, 9>> = self.0.energy.as_ref().map(energies);
    /// Name of the instruction set that the kernel uses.
    instructions(self) -> &'static str = instruction_set();
    /// Work done and skipped.
    statistics(self) -> Named<usize, 12> = statistics(&self.0.statistics);
}

/// Energies by name (J), and their relative residual.
pub(crate) fn energies(energy: &seismass::GeneralEnergy) -> Named<f64, 9> {
    Named([
        ("initial", energy.initial),
        ("input", energy.input),
        ("kinetic", energy.kinetic),
        ("viscous", energy.viscous),
        ("elastic", energy.elastic),
        ("hysteretic", energy.hysteretic),
        ("friction", energy.friction),
        ("contact", energy.contact),
        ("relative_residual", energy.relative_residual),
    ])
}
