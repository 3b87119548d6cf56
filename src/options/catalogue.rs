//! Every option, in one list.

use super::Preset;
use super::descriptor::{Choice, Control, Descriptor};

const BOTH: &[Preset] = Preset::ALL;
const BEST: &[Preset] = &[Preset::Best];
const PAPER: &[Preset] = &[Preset::Paper];

const DATA: &str = "Data term ψ²";
const SMOOTHNESS: &str = "Smoothness term μ g(‖∇Z‖)";
const LENGTH: &str = "Length term λ ∮ds";
const STOPPING: &str = "When to stop";

const fn number(min: f64, max: f64, logarithmic: bool) -> Control {
    Control::Number {
        min,
        max,
        automatic: false,
        logarithmic,
    }
}

const fn weight(max: f64) -> Control {
    Control::Number {
        min: 0.0,
        max,
        automatic: true,
        logarithmic: true,
    }
}

const fn count(max: f64) -> Control {
    Control::Integer { min: 1.0, max }
}

/// Every option in the order in which a form should show it.
pub fn catalogue() -> &'static [Descriptor] {
    CATALOGUE
}

static CATALOGUE: &[Descriptor] = &[
    Descriptor {
        key: "detail",
        group: "Frames",
        main: true,
        label: "Detail",
        meaning: "Size at which the frames are solved. The result is brought back to their own size along their edges. Weights and energies belong to the size that is solved. A change starts the solve again.",
        term: "frames",
        unit: "",
        presets: BOTH,
        control: Control::Choice {
            choices: &[
                Choice {
                    value: "fast",
                    label: "fast: 0.15 megapixels",
                },
                Choice {
                    value: "normal",
                    label: "normal: 0.5 megapixels",
                },
                Choice {
                    value: "fine",
                    label: "fine: 2 megapixels",
                },
                Choice {
                    value: "full",
                    label: "full: up to 16 megapixels",
                },
            ],
        },
    },
    Descriptor {
        key: "mu",
        group: SMOOTHNESS,
        main: true,
        label: "Smoothness μ",
        meaning: "Weight of the smoothness of depth, relative to the data term. Larger values give smoother depth.",
        term: "μ g(‖∇Z‖) in (7)",
        unit: "grey levels²",
        presets: BOTH,
        control: weight(1e9),
    },
    Descriptor {
        key: "lambda",
        group: LENGTH,
        main: true,
        label: "Length λ",
        meaning: "Cost of a curve per pixel of its length. Larger values give shorter, smoother outlines.",
        term: "λ ∮ds in (7)",
        unit: "grey levels²·px",
        presets: BOTH,
        control: weight(1e6),
    },
    Descriptor {
        key: "diffusion",
        group: SMOOTHNESS,
        main: true,
        label: "Diffusion",
        meaning: "The function that penalises changes of depth: (11) keeps depth edges, (12) blurs them.",
        term: "g in (7)",
        unit: "",
        presets: BOTH,
        control: Control::Choice {
            choices: &[
                Choice {
                    value: "anisotropic",
                    label: "edge-preserving (11)",
                },
                Choice {
                    value: "isotropic",
                    label: "blurring (12)",
                },
            ],
        },
    },
    Descriptor {
        key: "epsilon",
        group: SMOOTHNESS,
        main: false,
        label: "Edge scale ε",
        meaning: "The change of depth per pixel at which (11) begins to treat it as an edge. The mean inverse depth of a region is 1.",
        term: "g(r/ε) in (7)",
        unit: "1/px",
        presets: BOTH,
        control: number(1e-4, 10.0, true),
    },
    Descriptor {
        key: "smoothing",
        group: DATA,
        main: true,
        label: "Smoothing",
        meaning: "Standard deviation of the Gaussian that smooths both frames at the start.",
        term: "ψ in (7)",
        unit: "px",
        presets: BOTH,
        control: number(0.0, 5.0, false),
    },
    Descriptor {
        key: "lighting",
        group: DATA,
        main: false,
        label: "Brightness change",
        meaning: "Estimate a gain and an offset of brightness between the frames. A change starts the solve again.",
        term: "ψ in (7)",
        unit: "",
        presets: BEST,
        control: Control::Toggle,
    },
    Descriptor {
        key: "model_selection",
        group: DATA,
        main: false,
        label: "Model selection",
        meaning: "Give each region the simplest motion model (still, rotation, translation, or both) that explains it nearly as well as the best one.",
        term: "step 1",
        unit: "",
        presets: BEST,
        control: Control::Toggle,
    },
    Descriptor {
        key: "occlusion",
        group: DATA,
        main: false,
        label: "Occlusion",
        meaning: "Use a constant cost instead of the residual where a region in front hides the pixel in the second frame.",
        term: "ξ in (17)",
        unit: "",
        presets: BEST,
        control: Control::Toggle,
    },
    Descriptor {
        key: "discontinuities",
        group: SMOOTHNESS,
        main: false,
        label: "Depth discontinuities",
        meaning: "At the end, estimate depth pixel by pixel in regions whose depth has steps.",
        term: "step 2",
        unit: "",
        presets: BEST,
        control: Control::Toggle,
    },
    Descriptor {
        key: "rotation_ridge",
        group: DATA,
        main: false,
        label: "Rotation ridge",
        meaning: "Penalty on f·ω, because rotation and translation look alike in a small region. A share of the mean diagonal of the normal equations.",
        term: "step 1",
        unit: "",
        presets: PAPER,
        control: number(0.0, 1.0, true),
    },
    Descriptor {
        key: "depth_steps",
        group: SMOOTHNESS,
        main: false,
        label: "Depth steps",
        meaning: "Number of steps of (9) in each pass.",
        term: "step 2",
        unit: "",
        presets: PAPER,
        control: count(1000.0),
    },
    Descriptor {
        key: "curve_steps",
        group: LENGTH,
        main: false,
        label: "Curve steps",
        meaning: "Number of steps of (17) in each pass.",
        term: "step 3",
        unit: "",
        presets: PAPER,
        control: count(1000.0),
    },
    Descriptor {
        key: "max_passes",
        group: STOPPING,
        main: false,
        label: "Pass limit",
        meaning: "The solver stops after this number of passes, even if curves still move.",
        term: "stopping",
        unit: "",
        presets: BOTH,
        control: count(10000.0),
    },
    Descriptor {
        key: "tolerance",
        group: STOPPING,
        main: false,
        label: "Tolerance",
        meaning: "The solve has converged when fewer pixels than this share change their region in a pass.",
        term: "stopping",
        unit: "",
        presets: BOTH,
        control: number(0.0, 0.1, true),
    },
];
