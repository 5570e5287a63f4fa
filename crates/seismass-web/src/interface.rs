//! What JavaScript calls. Numbers go in through `seismass_input`, which gives room for them, and come out of
//! `seismass_output`; a function that can fail returns 0, or 1 with the reason in `seismass_message`.

// An exported name is the only thing here that the compiler cannot check: no other object of the page has it.
#![allow(unsafe_code)]

use std::cell::RefCell;

use seismass::{Domain, Error, Motion, Result};

use crate::case::Case;
use crate::design::elastic_shear_over_weight;
use crate::effective::Search;
use crate::run::run;
use crate::scatter::Resamples;

/// What is kept between two calls.
#[derive(Default)]
struct Session {
    input: Vec<f64>,
    output: Vec<f64>,
    message: String,
    motion: Option<Motion>,
    suite: Vec<Motion>,
    resamples: Resamples,
    search: Option<Search>,
}

thread_local! {
    static SESSION: RefCell<Session> = RefCell::default();
}

impl Session {
    fn motion_of_input(&self) -> Result<Motion> {
        let (dt, samples) = self.input.split_first().unwrap_or((&0.0, &[]));
        Motion::new(samples, *dt, None)
    }

    fn run(&mut self, share: f64, every: usize) -> Result<()> {
        let case = Case::new(&self.input)?;
        let scene = if share < 0.0 { case.real() } else { case.attached(share) }?;
        let motion = self.motion.as_ref().ok_or_else(|| missing("motion"))?;
        self.output = run(&scene, motion, every)?;
        Ok(())
    }

    fn search(&mut self) -> Result<&mut Search> {
        self.search.as_mut().ok_or_else(|| missing("search"))
    }
}

fn missing(what: &str) -> Error {
    Error::invalid(Domain::Options, what, "page", "given before it is used", "none")
}

/// Calls with the session; returns 0, or 1 with the message of the error.
fn tried(call: impl FnOnce(&mut Session) -> Result<()>) -> u32 {
    SESSION.with_borrow_mut(|session| match call(session) {
        Ok(()) => 0,
        Err(error) => {
            session.message = error.to_string();
            1
        }
    })
}

/// Room for so many numbers, which the next call takes.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_input(length: usize) -> *mut f64 {
    SESSION.with_borrow_mut(|session| {
        session.input.clear();
        session.input.resize(length, 0.0);
        session.input.as_mut_ptr()
    })
}

/// The numbers that the last call gave.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_output() -> *const f64 {
    SESSION.with_borrow(|session| session.output.as_ptr())
}

/// How many they are.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_output_length() -> usize {
    SESSION.with_borrow(|session| session.output.len())
}

/// Why the last call that failed did so, in UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_message() -> *const u8 {
    SESSION.with_borrow(|session| session.message.as_ptr())
}

/// How many bytes that are.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_message_length() -> usize {
    SESSION.with_borrow(|session| session.message.len())
}

/// Takes the motion of runs: time step (s), then samples (m/s2).
#[unsafe(no_mangle)]
pub extern "C" fn seismass_motion() -> u32 {
    tried(|session| {
        session.motion = Some(session.motion_of_input()?);
        Ok(())
    })
}

/// Takes a further motion of the suite, likewise.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_suite_motion() -> u32 {
    tried(|session| {
        let motion = session.motion_of_input()?;
        session.suite.push(motion);
        Ok(())
    })
}

/// Empties the suite.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_suite_clear() {
    SESSION.with_borrow_mut(|session| session.suite.clear());
}

/// Takes how often each resample has each motion of the suite, resample by resample.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_resamples() {
    SESSION.with_borrow_mut(|session| session.resamples = Resamples::new(session.suite.len(), &session.input));
}

/// Solves the case of the input: goods slide where the share is negative, else that share of them is attached. Histories
/// are kept at every so many samples; 0: none.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_run(share: f64, every: usize) -> u32 {
    tried(|session| session.run(share, every))
}

/// Gives V_e/W of each storey of the case of the input with a share of its goods counted, for the mean spectrum of the suite.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_design(counted: f64) -> u32 {
    tried(|session| {
        session.output = elastic_shear_over_weight(&Case::new(&session.input)?, counted, &session.suite)?;
        Ok(())
    })
}

/// Gives the stiffness of each storey (N/m) of the case of the input, with floors of 1 kg in the mean.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_stiffness() -> u32 {
    tried(|session| {
        session.output = Case::new(&session.input)?.stiffness()?;
        Ok(())
    })
}

/// Begins a search for the effective fraction of the case of the input; gives the mean peak base
/// shear with all goods attached over the weight, and friction over it.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_effective_begin() -> u32 {
    tried(|session| {
        session.search = None;
        let search = Search::new(Case::new(&session.input)?, session.suite.clone())?;
        session.output = search.base_shear().to_vec();
        session.search = Some(search);
        Ok(())
    })
}

/// Solves so many further shares; gives how many are left.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_effective_solve(shares: usize) -> u32 {
    tried(|session| {
        let left = session.search()?.solve(shares)?;
        session.output = vec![left as f64];
        Ok(())
    })
}

/// Gives what was found.
#[unsafe(no_mangle)]
pub extern "C" fn seismass_effective_answer() -> u32 {
    tried(|session| {
        let search = session.search.as_ref().ok_or_else(|| missing("search"))?;
        session.output = search.answer(&session.resamples)?;
        Ok(())
    })
}
