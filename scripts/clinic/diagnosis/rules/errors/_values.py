"""What to do about values that MuJoCo does not take, by its messages."""

from __future__ import annotations

from clinic.diagnosis.rules.errors._remedy import Remedy

VALUES = (
    Remedy(
        "must have positive width",
        "A tendon is drawn 0.003 m wide where nothing is written.",
        ("-width", "width=0.003"),
    ),
    Remedy("invalid springlength", "The shorter length comes first.", ("springlength<", "springlength+")),
    Remedy(
        r"range\[0\]<range\[1\] required in muscle",
        "The range of a muscle is its operating lengths, the shorter one first; 0.75 1.05 is the default.",
        ("range<", "-range"),
    ),
    Remedy(
        "lmin<1<lmax",
        "Lengths are in units of the optimal length, 1; 0.5 and 1.6 are the defaults.",
        ("-lmin", "-lmax", "-lmin;-lmax"),
    ),
    Remedy(
        "positive scale, vmax, fpmax, fvmax",
        "Without the attribute the default is taken, which is positive.",
        ("-scale", "-vmax", "-fpmax", "-fvmax", "-scale;-vmax;-fpmax;-fvmax"),
    ),
    Remedy(
        "invalid control range",
        "Controls that are limited need a ctrlrange whose first number is the smaller one.",
        ("ctrlrange<;-ctrllimited", "-ctrllimited;-ctrlrange", "ctrlrange=0 1", "ctrlrange=-1 1"),
    ),
    Remedy(
        "invalid force range",
        "Forces that are limited need a forcerange whose first number is the smaller one.",
        ("-forcelimited;-forcerange", "forcerange=-1 1"),
    ),
    Remedy(
        "invalid actrange",
        "An activation that is limited needs an actrange whose first number is the smaller one.",
        ("-actlimited;-actrange", "actrange=-1 1"),
    ),
    Remedy(
        "(?:damper|adhesion) control range cannot be negative",
        "The control of a damper or an adhesion is not negative: 0 1 goes from nothing to all of it.",
        ("ctrlrange=0 1",),
    ),
    Remedy("crank length must be positive", "cranklength is the length of the rod in m.", ("cranklength=0.1",)),
    Remedy("invalid actdim|actdim > 1", "MuJoCo finds the number of activations by itself.", ("-actdim",)),
    Remedy(
        "DC motor: motor constant K",
        "motorconst is the torque in N m for each A, as in the data sheet; 0.05 is a guess.",
        ("motorconst=0.05", "motorconst=0.05;resistance=1"),
    ),
    Remedy("DC motor: resistance R", "resistance is that of the winding in ohm; 1 is a guess.", ("resistance=1",)),
    Remedy(
        r"DC motor: (?:thermal )?(\w+)", "Values of a motor are as in the data sheet, and positive.", ("{0}+", "-{0}")
    ),
    Remedy("disabled actuator group", "Groups are numbered from 0 to 30.", ("-actuatorgroupdisable",)),
    Remedy("invalid condim in contact pair", "condim is 1, 3, 4 or 6.", ("condim=3", "condim=6")),
    Remedy(
        "invalid condim",
        "condim is 1 without friction, 3 with it, 4 with torsional and 6 with rolling friction.",
        ("condim=3",),
    ),
    Remedy(
        "fromto requires",
        "A geom between two points is a capsule, a cylinder, a box or an ellipsoid.",
        ("type=capsule;-mesh", "-fromto"),
    ),
    Remedy("fromto cannot be used", "A mesh has its place by pos and quat.", ("-fromto",)),
    Remedy(
        "(x|y|z)axis too small|cross.* too small|axisangle too small",
        "An axis needs a length, and two axes may not be parallel; without it the element is not turned.",
        ("-xyaxes", "-zaxis", "-axisangle"),
    ),
    Remedy(
        "hfields and planes not allowed in site|height fields are not",
        "A site is a sphere, capsule, ellipsoid, cylinder, box or mesh; a flat box stands for a plane.",
        ("type=box;size=0.1 0.1 0.001", "-type"),
    ),
    Remedy(
        "World body cannot have attributes",
        "What the world is called and where it stands is fixed; a <body> or <frame> inside can have both.",
        ("-name", "-pos", "-quat", "-euler", "-name;-pos;-quat;-euler;-childclass;-gravcomp"),
    ),
    Remedy(
        "must have exactly 3 characters|euler sequence can only|seq must contain",
        "eulerseq is three of x, y, z, in capitals for fixed axes: XYZ are the roll, pitch, yaw of ROS.",
        ("eulerseq=XYZ",),
    ),
    Remedy(
        r"(extent|znear|zfar|meaninertia|meansize|meanmass) must be",
        "MuJoCo has a value of its own where nothing is written.",
        ("-{0}",),
    ),
    Remedy(
        "No cubefiles_ defined",
        "A texture is a file or a builtin pattern, and a cube where no type is written; a grey one is put in.",
        ("builtin=flat;width=8;height=8", "type=2d;builtin=flat;width=8;height=8"),
    ),
    Remedy(
        "Cannot load 2D texture from separate files",
        "A texture of type 2d is one file or a builtin pattern; a grey one is put in.",
        ("type=cube", "builtin=flat;width=8;height=8"),
    ),
    Remedy(
        "Invalid (?:width|height) of builtin texture",
        "A builtin texture needs width and height in pixels.",
        ("width=100", "height=100", "width=100;height=100"),
    ),
    Remedy(
        "gridlayout|gridsize|PNG size must be integer multiple|must be square",
        "A cube or skybox is six squares in one file (gridsize, gridlayout), or one square for all; "
        "a picture to lay on surfaces is type 2d.",
        ("type=2d;-gridsize;-gridlayout", "-gridlayout;-gridsize"),
    ),
    Remedy(
        "hfield not specified",
        "A height field has a file, or nrow and ncol, and then heights of zero, into which a program can write.",
        ("nrow=10;ncol=10",),
    ),
    Remedy(
        "size parameter is not positive in hfield",
        "size is half the length, half the width, the height of the highest point and the depth of the base, in m.",
        ("size=1 1 0.1 0.1",),
    ),
    Remedy(
        "hfield dimensions must be",
        "A height field has at least two rows and two columns.",
        ("nrow=2", "ncol=2", "nrow=2;ncol=2"),
    ),
    Remedy("mesh surface area is too small", "The scale makes the mesh next to nothing.", ("-scale",)),
    Remedy("fovy too large", "fovy is the vertical field of view in degrees, below 180.", ("fovy=45",)),
    Remedy(
        "focal/principal require sensorsize",
        "Focal lengths in m are of a sensor of some size in m: write its sensorsize, or fovy in their place.",
        ("-sensorsize;-focal;-principal;-focalpixel;-principalpixel",),
    ),
    Remedy("zero direction in light", "A light shines down where no dir is written.", ("-dir",)),
    Remedy(
        "Poisson ratio",
        "A ratio of 0.5 does not compress at all, which no element can do; rubber is 0.45 to 0.49.",
        ("elasticity/poisson=0.45",),
    ),
    Remedy(
        "flex constraints and elasticity",
        "A flex holds its edges by constraints or is elastic, not both; the constraints are taken off.",
        ("edge/-equality",),
    ),
    Remedy("edge stiffness only available", "Surfaces and solids have an <elasticity> instead.", ("edge/-stiffness",)),
    Remedy(
        "flex constraints and edge stiffness", "The edges are constraints or springs, not both.", ("edge/-stiffness",)
    ),
    Remedy("Spacing must be larger", "The points are closer than the radius around each of them.", ("radius=0.001",)),
    Remedy("Invalid dim", "dim is 1 for a rope, 2 for a cloth and 3 for a solid.", ("dim=3", "dim=2")),
    Remedy("Mass and inertiabox", "mass is that of all points together in kg.", ("-mass;-inertiabox",)),
    Remedy("Scale must be larger", "A scale of zero leaves no points.", ("-scale",)),
    Remedy("pinid out of range", "A pin names points by their numbers from 0.", ("pin/delete",)),
    Remedy(
        "Pin (?:grid|range)",
        "A pin of a grid is a place for each dimension: 0 0 for the first corner of a cloth.",
        ("pin/grid=0 0", "pin/grid=0 0 0", "pin/delete"),
    ),
    Remedy(
        "element \\d+ has point id|[Cc]ount\\[2\\] must be 1|Grid count must be",
        "A grid has as many counts above 1 as its dim.",
        ("dim=3", "dim=2", "dim=1"),
    ),
    Remedy(
        "No elements were created|Count too small|Box/cylinder|Mesh dim must be",
        "A count is 2 at least in every direction that the shape has.",
        ("count=3 3 3", "count=3 3 3;dim=3"),
    ),
    Remedy(
        "origin must be specified for mesh",
        "origin is a point inside of the mesh, from which the solid is cut into pieces.",
        ("origin=0.1 0.1 0.1", "dim=2"),
    ),
    Remedy("custom field size must be positive", "A numeric has data, or a size.", ("data=0;-size", "size=1")),
    Remedy("text field cannot be empty", "A text has data.", ("delete",)),
    Remedy("tuple .* is empty", "What names nothing is taken out.", ("delete",)),
    Remedy(
        r"(\w+) has more values than (\w+)|user has more",
        "<size> says how many numbers user may have; without it MuJoCo counts them.",
        (),
    ),
    Remedy(
        "elevation data length",
        "elevation has nrow times ncol numbers; without it all heights are zero.",
        ("-elevation",),
    ),
    Remedy(r"nan (\w+) in", "nan is no number that a model can be made of.", ("-{0}", "{0}=0.01 0.01 0.01")),
    Remedy("builtin textures must have 3", "A pattern has three channels; one with alpha is a file.", ("-nchannel",)),
    Remedy(
        "number is too large in attribute '(contype|conaffinity)'",
        "A collision mask is at most 2147483647 in the text.",
        ("{0}=1",),
    ),
    Remedy("'num' must be positive", "num is how many contacts are told; 1 is the default.", ("-num",)),
    Remedy(
        "^(?!attribute).*(?:solref|solimp)",
        "Both numbers of solref have the same sign; without it the default is taken.",
        ("-solref", "-solreflimit", "-solimp"),
    ),
)
