//! What the feature `tall-buildings` adds. Without it: `cargo test -p seismass --no-default-features --test tall_buildings`.

use seismass::{Building, Damping, MAX_STOREYS, Storey, UniformBuilding};

/// Most storeys with and without the feature.
const MOST: usize = if cfg!(feature = "tall-buildings") { 1000 } else { 4 };

fn building(storeys: usize) -> UniformBuilding {
    UniformBuilding { storeys, period: 1.0, mass: 1000.0, ..Default::default() }
}

#[test]
fn a_taller_building_is_refused() {
    assert_eq!(MAX_STOREYS, MOST);
    let message = format!("storeys of building must be at most {MOST}; got {}", MOST + 1);
    assert_eq!(building(MOST + 1).build().unwrap_err().to_string(), message);
    let (mass, storeys) = (vec![1.0; MOST + 1], vec![Storey::elastic(1.0); MOST + 1]);
    assert_eq!(Building::new(mass, storeys, Damping::default()).unwrap_err().to_string(), message);
    assert_eq!(building(4).build().unwrap().len(), 4);
}
