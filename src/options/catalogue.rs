//! Every option, in one list.

use super::descriptor::{Choice, Control, Descriptor};

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

const fn toggle(
    key: &'static str,
    label: &'static str,
    meaning: &'static str,
    term: &'static str,
) -> Descriptor {
    Descriptor {
        key,
        label,
        meaning,
        term,
        unit: "",
        control: Control::Toggle,
    }
}

/// Every option in the order in which a form should show it.
pub fn catalogue() -> &'static [Descriptor] {
    CATALOGUE
}

static CATALOGUE: &[Descriptor] = &[
    Descriptor {
        key: "mu",
        label: "Smoothness μ",
        meaning: "How much smooth depth counts against fitting the frames.",
        term: "μ g(‖∇Z‖) in (7)",
        unit: "grey levels²",
        control: weight(1e6),
    },
    Descriptor {
        key: "lambda",
        label: "Length λ",
        meaning: "How much a pixel of curve costs: larger gives shorter, smoother outlines.",
        term: "λ ∮ds in (7)",
        unit: "grey levels²·px",
        control: weight(1e6),
    },
    Descriptor {
        key: "diffusion",
        label: "Diffusion",
        meaning: "What smooths depth: a function that keeps depth edges, or one that blurs them.",
        term: "g in (7)",
        unit: "",
        control: Control::Choice {
            choices: &[
                Choice {
                    value: "anisotropic",
                    label: "edge-keeping (11)",
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
        label: "Edge scale ε",
        meaning: "Depth gradient from which (11) takes a step for an edge; a region's mean inverse depth is 1.",
        term: "g(r/ε) in (7)",
        unit: "1/px",
        control: number(1e-3, 10.0, true),
    },
    Descriptor {
        key: "motion",
        label: "Motion step",
        meaning: "How a region's T and ω are found. With one depth field for all regions it is held fixed.",
        term: "step 1",
        unit: "",
        control: Control::Choice {
            choices: &[
                Choice {
                    value: "least-squares",
                    label: "least squares, depth fixed",
                },
                Choice {
                    value: "joint",
                    label: "depth eliminated",
                },
            ],
        },
    },
    Descriptor {
        key: "rotation_ridge",
        label: "Rotation ridge",
        meaning: "Pull of f·ω towards 0, which a small region cannot tell from translation; a share of the mean diagonal of the normal equations.",
        term: "step 1",
        unit: "",
        control: number(0.0, 1.0, true),
    },
    Descriptor {
        key: "depth",
        label: "Depth step",
        meaning: "How depth is found.",
        term: "step 2",
        unit: "",
        control: Control::Choice {
            choices: &[
                Choice {
                    value: "descent",
                    label: "descent (9), one field",
                },
                Choice {
                    value: "layers",
                    label: "1/Z, a field per region",
                },
            ],
        },
    },
    toggle(
        "bodies",
        "Bodies from patches",
        "Let each curve start on the body that it is drawn on, as far as small patches show where that ends. Coarse to fine only.",
        "step 3",
    ),
    toggle(
        "search",
        "Search directions",
        "Look for T over the whole sphere of directions, depth eliminated, before it is refined. Coarse to fine only.",
        "step 1",
    ),
    toggle(
        "choose_kind",
        "Choose kinds",
        "Take the simplest of still, rotation, translation and full motion that explains a region nearly as well as the best. Coarse to fine only.",
        "step 1",
    ),
    toggle(
        "robust",
        "Robust fit",
        "Count large residuals less than their square when motion and depth are fitted. Coarse to fine only.",
        "ψ in (7)",
    ),
    toggle(
        "normalised",
        "Fair competition",
        "Let regions compete in units of each residual's uncertainty, so that strong texture does not out-vote weak. Coarse to fine only.",
        "ξ in (17)",
    ),
    toggle(
        "lighting",
        "Light may change",
        "Allow for a gain and an offset between the frames, and for smooth changes of brightness over each region. Switching it starts anew. Coarse to fine only.",
        "ψ in (7)",
    ),
    toggle(
        "gradients",
        "Gradients compete",
        "Until curves have settled, let regions compete for a pixel by the gradient of brightness as well, which tells texture from a change of light. Coarse to fine only.",
        "ξ in (17)",
    ),
    toggle(
        "occlusion",
        "Excuse the hidden",
        "Charge a constant, not the residual, where a region in front covers the place that a pixel goes to. Coarse to fine only.",
        "ξ in (17)",
    ),
    toggle(
        "islands",
        "No islands",
        "Keep curves in one piece: islands and small holes go. Coarse to fine only.",
        "step 3",
    ),
    toggle(
        "partition",
        "Least partition",
        "Draw in at once, twice, what is not worth its outline, instead of step by step. Coarse to fine only.",
        "step 3",
    ),
    toggle(
        "growth",
        "Growth",
        "Fit each region to what lies around it as well, and let it keep whatever then makes (7) clearly smaller: it wins back what another has bent its depth after. Coarse to fine only.",
        "step 3",
    ),
    toggle(
        "sweep",
        "Sweep of depths",
        "Where a region's depth does not explain its pixels, as behind a thing that stands before another, try every depth there. Coarse to fine only.",
        "step 2",
    ),
    toggle(
        "edges",
        "Edges of brightness",
        "Let outlines cost less, and the background's depth step, where brightness has an edge: what motion leaves open is decided there. Coarse to fine only.",
        "λ ∮ds and g(‖∇Z‖) in (7)",
    ),
    toggle(
        "cross_validation",
        "Cross-validation",
        "Once all stands still, hold motions, and give each region the smoothness that best foretells pixels left out of its fit. Coarse to fine only, where μ is chosen from the data.",
        "μ in (7)",
    ),
    Descriptor {
        key: "depth_steps",
        label: "Depth steps",
        meaning: "Steps of (9) in a pass.",
        term: "step 2",
        unit: "",
        control: Control::Integer {
            min: 1.0,
            max: 1000.0,
        },
    },
    Descriptor {
        key: "curve_steps",
        label: "Curve steps",
        meaning: "Steps of (17) in a pass.",
        term: "step 3",
        unit: "",
        control: Control::Integer {
            min: 1.0,
            max: 1000.0,
        },
    },
    Descriptor {
        key: "smoothing",
        label: "Smoothing",
        meaning: "Standard deviation of the Gaussian that both frames are smoothed with before they are differentiated.",
        term: "ψ in (7)",
        unit: "px",
        control: number(0.0, 5.0, false),
    },
    Descriptor {
        key: "max_passes",
        label: "Most passes",
        meaning: "Passes after which the solver stops even if curves still move.",
        term: "stopping",
        unit: "",
        control: Control::Integer {
            min: 1.0,
            max: 10000.0,
        },
    },
    Descriptor {
        key: "tolerance",
        label: "Tolerance",
        meaning: "Share of pixels that may change region in a pass that still counts as standing still.",
        term: "stopping",
        unit: "",
        control: number(0.0, 0.1, true),
    },
];
