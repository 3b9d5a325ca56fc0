//! The squeezed layer: the series that it has without compressible water, and that it has at small strain.

use approx::assert_relative_eq;
use proctor_verification::exact::consolidation::Layer;
use proctor_verification::exact::squeezed_layer::SqueezedLayer;

const LAYER: SqueezedLayer = SqueezedLayer {
    height: 2.0,
    confined_modulus: 1e6,
    bulk_water: f64::INFINITY,
    porosity: 0.7,
    mobility: 1e-9,
    load: 8e5,
    ramp: 1.0,
};

fn layer(of: &SqueezedLayer) -> Layer {
    Layer {
        height: of.height,
        confined_modulus: of.confined_modulus,
        storage: of.bulk_water / of.porosity,
        mobility: of.mobility,
        load: of.load,
    }
}

/// Water that keeps its volume: Xie and Leo's series, of a load that comes on in the middle of its ramp.
#[test]
fn stiff_water_has_the_series_of_large_strain() {
    let t = 0.3 * 4.0 / (LAYER.mobility * LAYER.confined_modulus);
    let (state, series) = (LAYER.at(t + 0.5 * LAYER.ramp), layer(&LAYER));
    for z in [0.0, 0.7, 1.4, 1.9] {
        let exact = series.large_pressure(z, t);
        assert_relative_eq!(state.pressure(z), exact, epsilon = 2e-5 * LAYER.load);
    }
    let settled = series.large_settlement(t);
    assert_relative_eq!(state.displacement(2.0), settled, max_relative = 2e-5);
}

/// A load of a millionth of the modulus: Terzaghi's series with water that can be compressed.
#[test]
fn little_load_has_the_series_of_compressible_water() {
    let little = SqueezedLayer {
        bulk_water: 5e6,
        load: 1.0,
        ..LAYER
    };
    let (series, t) = (layer(&little), 1000.0);
    let state = little.at(t + 0.5 * little.ramp);
    for z in [0.0, 0.7, 1.4, 1.9] {
        assert_relative_eq!(
            state.pressure(z),
            series.pressure(z, t, 0.0),
            epsilon = 2e-5
        );
    }
    let settled = series.settlement(t, 0.0);
    assert_relative_eq!(state.displacement(2.0), settled, max_relative = 2e-5);
}

/// The top sinks as far as the sum of what lies below it, and is free of pressure.
#[test]
fn the_top_is_drained() {
    let soft = SqueezedLayer {
        bulk_water: 2e7,
        ..LAYER
    };
    let state = soft.at(400.0);
    assert!(state.pressure(2.0).abs() < 1e-6 * LAYER.load);
    assert!(state.displacement(0.0) == 0.0);
    assert!(state.displacement(2.0) < state.displacement(1.0));
}
