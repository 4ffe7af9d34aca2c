"""Well-known arms: how far apart the axes of their joints are, and which way these turn, as the makers describe them.

Two lines have a distance and an angle, and three lines in a row have an offset along the middle one, wherever the
frames of the bodies are: the parameters a, alpha and d of Denavit and Hartenberg, *A Kinematic Notation for Lower-Pair
Mechanisms Based on Matrices*, 1955. So a model is compared with a data sheet whatever its frames are.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import NamedTuple

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.vector import Vector, add, cross, dot, norm, sub
from clinic.diagnosis.simulation import Simulation, kept

PARALLEL = 0.02  # the sine of an angle
NEAR, SHARE = 0.002, 0.01  # m, and of a length: nearer to the data sheet than both of these is alike
ALONG = 0.99
QUARTER = {"x": "y", "y": "-x", "-x": "-y", "-y": "x"}

# Name and other spellings; in mm the distances of the axes in a row, then the offsets along all but the first and the
# last of them; the axes, as the arm stands at 0; how far above the base the first and the second axis are nearest to
# each other, in mm; and what the links together weigh, in kg. A maker's arms have their axes in common, and no lengths.
TABLE = """
irb1200,irb_1200  0 448 42 0 0  0 0 451 0  z y y x y x  -  -
irb1200_7_70  0 350 42 0 0  0 0 351 0  z y y x y x  -  -
irb2400,irb_2400  100 705 135 0 0  0 0 755 0  z y y x y x  -  -
irb4600  175 900 175 0 0  0 0 960 0  z y y x y x  -  -
irb6640,irb_6640  320 1075 200 0 0  0 0 1392 0  z y y x y x  -  -
crb15000,gofa_5  0 444 110 0 80  0 0 470 0  z y y x y x  -  -
irb1600,irb_1600_12  150 475 0 0 0  0 0 600 0  z y y x y x  -  -
irb1600_10_145,irb1600_8_145,irb1600_145  150 700 0 0 0  0 0 600 0  z y y x y x  -  -
irb6700  320 1125 200 0 0  0 0 1142.5 0  z y y x y x  -  -
irb2600  150 700 115 0 0  0 0 795 0  z y y x y x  -  -
irb120,irb_120  0 270 70 0 0  0 0 302 0  z y y x y x  -  11.9
irb140t_6_81,irb140,irb_140  70 360 0 0 0  0 0 380 0  z y y x y x  -  -
irb4600_20_250,irb4600_250  175 1095 175 0 0  0 0 1235 0  z y y x y x  -  -
irb7600  410 1075 165 0 0  0 0 2012 0  z y y x y x  -  -
crb15000_12_127,gofa12,gofa_12  0 707 110 0 80  0 0 534 0  z y y x y x  -  -
lrmate200id,lrmate200id7,lr_mate_200id,cr7ia,cr_7ia  50 330 35 0 0  0 0 335 0  z y -y -x -y -x  -  -
lrmate200id7l,lr_mate_200id_7l  50 440 35 0 0  0 0 420 0  z y -y -x -y -x  -  -
lrmate200ic,lr_mate_200ic  75 300 75 0 0  0 0 320 0  z y -y -x -y -x  -  -
lrmate200ic5l,lr_mate_200ic_5l  75 400 75 0 0  0 0 410 0  z y -y -x -y -x  -  -
m20ia,m_20ia  150 790 250 0 0  0 0 835 0  z y -y -x -y -x  -  -
r2000ic165f,r2000ic,r_2000ic_165f,r2000ib210f,r2000ib,r_2000ib_210f  312 1075 225 0 0  0 0 1280 0  z y -y -x -y -x  -  -
m710ic50,m710ic,m_710ic_50  150 870 170 0 0  0 0 1016 0  z y -y -x -y -x  -  -
cr35ia,cr_35ia  150 790 150 0 0  0 0 860 0  z y -y -x -y -x  -  -
m10ia,m_10ia  150 600 200 0 0  0 0 640 0  z y -y -x -y -x  -  -
lrmate200id4s,lr_mate_200id_4s,lrmate200id4sh  0 260 20 0 0  0 0 290 0  z y -y -x -y -x  -  -
m20ib25,m_20ib_25  75 905 120 0 0  0 0 865 0  z y -y -x -y -x  -  -
m10id12,m10id,m_10id_12  75 640 195 0 0  0 0 700 0  z y -y -x -y -x  -  -
crx10ial,crx10ia_l,crx_10ia_l  0 710 0 0 0  0 0 540 150  z y -y -x -y -x  -  -
m900ia260l,m900ia,m_900ia_260l  370 1050 200 0 0  0 0 1705 0  z y -y -x -y -x  -  -
r1000ia80f,r1000ia,r_1000ia_80f  320 870 225 0 0  0 0 1015 0  z y -y -x -y -x  -  -
lrmate200ib,lr_mate_200ib  150 250 75 0 0  0 0 290 0  z y -y -x -y -x  -  -
panda,franka,fer,fr3,fr3v2  0 0 82.5 82.5 0 88  0 316 0 384 0  z y z -y z -y -z  333  16.1
iiwa14,iiwa_14,med14,med_14  0 0 0 0 0 0  0 420 0 400 0  z y z -y z y z  360  25.6
iiwa7,lbr_iiwa_7_r800,kuka_iiwa_7,med7,med_7  0 0 0 0 0 0  0 400 0 400 0  z y z -y z y z  340  19
j2s7s300,jaco2_7dof,j2s7s200  0 0 0 0 0 0  1.6 410 11.4 311 0  -z -y z y -z -y z  -  -
j2n6s300,jaco2,j2n6s200  0 410 0 0 0  0 9.8 250.1 85.5  -z -y y -z -y -z  -  -
kr6r900sixx,kr6_r900_sixx,kr_6_r900  25 455 35 0 0  0 0 420 0  -z y y -x y -x  -  -
kr6r700sixx,kr6_r700_sixx,kr_6_r700  25 315 35 0 0  0 0 365 0  -z y y -x y -x  -  -
kr10r1100sixx,kr10_r1100_sixx,kr_10_r1100  25 560 35 0 0  0 0 515 0  -z y y -x y -x  -  -
kr16  260 680 35 0 0  0 0 670 0  -z y y -x y -x  -  -
kr120r2500pro,kr120_r2500_pro  350 1150 41 0 0  0 0 1000 0  -z y y -x y -x  -  -
kr3r540,kr3_r540,kr_3_r540  20 260 20 0 0  0 0 260 0  -z y y -x y -x  -  -
xarm7,xarm_7  0 0 52.5 77.5 0 76  0 293 0 342.5 0  z y z -y -z y -z  267  10.4
lite6,lite_6  0 200.2 87 0 0  0 0 227.6 0  z y -y -z y -z  -  5.92
gen3,kortex  0 0 0 0 0 0  11.7 420.8 12.7 314.4 0  -z y -z y -z y -z  -  6.49
sawyer  81 0 0 0 0 0  192.5 400 168.5 400 136.3  z y x y x y x  -  17.1
wx250s,widowx_250s  0 254.9 0 0 0  0 0 250 0  z y y x y x  -  1.56
unitree_z1  0 350 225.3 70 0  0 0 0 0  z y y y z x  -  3.95
piper  0 285 22 0 0  0 0 250.8 1.4  z y y x y x  -  -
m1013  0 620 0 0 0  0 34.6 559 0  z y y z y z  -  30.1
rizon4,rizon_4  0 0 20 20 0 110  65 395 55 385 103  z -y z y z -y x  -  16.3
tm5_900,tm5x_900  0 429 411.5 0 0  0 0 122.2 106  z y y y z -y  -  19.2
tm12,tm12x  0 636.1 557.9 0 0  0 0 156.3 106  z y y y z -y  -  -
gen3_6dof  0 410 0 0 0  0 1 314.4 0  -z y -y -z -y -z  -  5.29
gen3_lite,gen3lite  0 280 0 0 0  0 10 245 57  z -y y z x z  -  -
m0609  0 411 0 0 0  0 6.2 368 0  z y y z y z  -  -
a0509  0 409 0 0 0  0 0 367 0  z y y z y z  -  -
h2017  0 845 0 0 0  0 9.9 734 0  z y y z y z  -  -
aubo_i5  0 408 376 0 0  0 0 121.5 102.5  z -y y -y z -y  -  9.05
elfin5,elfin_5  0 380 0 0 0  0 0 420 0  z -y y z y z  -  10.9
vs060,vs060a3  0 305 10 0 0  0 0 300 0  z y y z y z  -  -
rm_65,rm65  0 256 0 0 0  0 0 210 0  z -y -y z -y z  -  5.31
rm_75,rm75  0 0 0 0 0 0  0 256 0 210 0  z y z y z y z  -  5.91
cr5,cr5a  0 427 357 0 0  0 0 141 116  z -y -y -y z -y  -  11.5
zu7,jaka_zu_7  0 360 303.5 0 0  0 0 115 113.5  z -y -y -y -z -y  -  -
iisy,lbr_iisy3  0 300 0 0 0  0 0 300 0  -z y y -x y -x  -  14.2
vx300s,viperx_300s,viper_x300s  0 305.9 0 0 0  0 0 300 0  z y y x y x  -  2.54
xarm6,xarm_6  0 289.5 77.5 0 76  0 0 342.5 0  z y y -z y -z  267  7.75
xarm5  0 289.6 350.7 76  0 0 0  -z y y y -z  267  6.59
tm5_700,tm5x_700  0 329 311.5 0 0  0 0 122.2 106  z y y y z -y  -  -
yumi,irb14000  30 30 41.9 40.5 27 27  0 251.6 0 265 0  z -y z -y -x -y -x  -  -
sia5d,sia5,sia5f  0 0 85 60 0 0  0 270 0 270 0  z y z -y -x -y -x  -  -
tm14,tm14x  0 536.1 457.9 0 0  0 0 156.3 106  z y y y z -y  -  -
i10  0 647 600.5 0 0  0 0 201.3 102.5  z -y y -y z -y  -  -
nova5  0 400 330 0 0  0 0 135 120  z -y -y -y z -y  -  6.18
cr10,cr10a  0 607 568 0 0  0 0 191 125  z -y -y -y z -y  -  23
eco65  86 260 240 0 0  0 0 58.9 109.8  z y y y z y  -  3.72
m1509  0 411 0 0 0  0 34.5 368 0  z y y z y z  -  -
iisy11  0 590 0 0 0  0 0 532 0  -z y y -x y -x  -  -
arx  20 264 252.2 73.9 0  0 0 0 0  z y -y -y -z x  -  -
elfin3,elfin_3  0 266 0 0 0  0 0 324 0  z -y y z y z  -  -
cobotta,cvr038a1  0 165 12 0 0  0 20 177.5 64.5  z y y z y z  -  -
baxter  69 0 69 0 10 0  0 364.4 0 374.3 0  z y x y x y x  -  19.5
uf850,ufactory_850,uf_850  0 390 150 0 0  0 0 426 0  z -y y -z -y -z  -  -
rs007n  0 355 0 0 0  0 0 375 0  -z -x x z x z  -  26
rs080n  150 870 0 0 0  0 0 1080 0  -z -x x z x z  -  -
rv2fr,rv_2fr  0 230 50 0 0  0 0 270 0  z y y z y z  -  -
rv7frl,rv_7frl  0 435 50 0 0  0 0 470 0  z y y z y z  -  -
fairino5,fr5  0 425 395 0 0  0 0 102.1 102  z -y -y -y -z -y  -  -
lwa4p,powerball  0 350 0 0 0  0 0 305 5.3  z -y y z y z  -  -
lwr4,kuka_lwr,lwr4plus,lwr_4+  0 0 0 0 0 0  0 400 0 390 0  z -y z y z -y z  -  -
rb5  0 425 392 0 0  0 0 110.7 110.7  z y y y z y  -  -
rb10  0 612.7 570.2 0 0  0 0 156.2 117.2  z y y y z y  -  -
ec66  0 418 398 0 0  0 0 122 98  z y y y -z -y  -  10.1
gp7  40 445 40 0 0  0 0 440 0  z y -y -x -y -x  -  -
gp12,mh12  155 614 200 0 0  0 0 640 0  z y -y -x -y -x  -  -
gp25  150 760 200 0 0  0 0 795 0  z y -y -x -y -x  -  -
hc10,hc10dt  0 700 0 0 0  0 0 500 162  z y -y z -y z  -  -
sia10d,sia10  0 0 0 0 0 0  0 360 0 360 0  z y z -y -z -y -z  -  -
sia20d,sia20  0 0 0 0 0 0  0 490 0 420 0  z y z -y -z -y -z  -  -
mh5  88 310 39.9 0 0  0 0 305 0  z y -y -x -y -x  -  -
gp8  40 345 40 0 0  0 0 340 0  z y -y -x -y -x  -  -
hc20,hc20dtp  0 820 0 0 0  0 0 880 0  z y -y -x -y -x  -  -
gp4  0 260 15 0 0  0 0 290 0  z y -y -x -y -x  -  -
mh50,gp50  145 870 210 0 0  0 0 1025 0  z y -y -x -y -x  -  -
hc10dtp  0 700 0 0 0  0 0 500 162  z y -y -x -y -x  -  -
gp180  325 1150 300 0 0  0 0 1225 0  z y -y -x -y -x  -  -
tx60,tx2_60,tx260  0 290 0 0 0  0 20 310 0  z y y z y z  -  -
tx90,tx2_90,tx290  50 425 0 0 0  0 50 425 0  z y y z y z  -  -
rx160  150 825 0 0 0  0 0 625 0  z y y z y z  -  -
tx2_90l,tx290l,tx90l  50 500 0 0 0  0 50 550 0  z y y z y z  -  -
tx60l,tx2_60l  0 400 0 0 0  0 20 450 0  z y y z y z  -  -
ur3  0 243.6 213.2 0 0  0 0 112.3 85.3  z y y y -z y  151.9  8.63
ur5  0 425 392.3 0 0  0 0 109.1 94.6  z y y y -z y  89.2  17
ur10  0 612 572.3 0 0  0 0 163.9 115.7  z y y y -z y  127.3  28.7
ur3e  0 243.6 213.2 0 0  0 0 131 85.3  z y y y -z y  151.85  8.8
ur5e  0 425 392.2 0 0  0 0 133.3 99.7  z y y y -z y  162.5  17.7
ur16e  0 478.4 360 0 0  0 0 174.1 119.9  z y y y -z y  180.7  27.3
ur20  0 862 728.7 0 0  0 0 201 159.3  z y y y -z y  236.3  61
ur30  0 637 503.7 0 0  0 0 201 159.3  z y y y -z y  236.3  -
ur15  0 647.5 516.4 0 0  0 0 182.4 136.1  z y y y -z y  -  36.3
fanuc  -  -  z y -y -x -y -x  -  -
motoman,yaskawa  -  -  z y -y -x -y -x  -  -
abb  -  -  z y y x y x  -  -
kuka_kr  -  -  -z y y -x y -x  -  -
staubli  -  -  z y y z y z  -  -
"""


@dataclass(frozen=True)
class Arm:
    """An arm of a data sheet.

    Attributes:
        names: How it is called, in lower case; the first is its name.
        lengths: The distance of each axis from the next, in m.
        offsets: From one axis to the next but one, along the axis between them, in m; positive.
        axes: The directions of the axes as the arm stands at 0: `z`, `-y`.
        height: From the base along the first axis to where the second is nearest to it, in m; None where not known.
        mass: Of all links that move, in kg; None where not known.
    """

    names: tuple[str, ...]
    lengths: tuple[float, ...]
    offsets: tuple[float, ...]
    axes: tuple[str, ...]
    height: float | None
    mass: float | None

    @property
    def numbers(self) -> tuple[float, ...]:
        """Its lengths and offsets."""
        return (*self.lengths, *self.offsets)


class Measured(NamedTuple):
    """As many hinges in a row as an arm has: their joints, and the same numbers of them.

    `shoulder` is the place on the first axis where the second is nearest to it.
    """

    joints: tuple[int, ...]
    shoulder: Vector
    lengths: tuple[float, ...]
    offsets: tuple[float, ...]
    axes: tuple[Vector, ...]

    @property
    def numbers(self) -> tuple[float, ...]:
        """Their lengths and offsets."""
        return (*self.lengths, *self.offsets)


@cache
def known_arms() -> tuple[Arm, ...]:
    """The arms of the table."""
    return tuple(_arm(*re.split(r"\s{2,}", line)) for line in TABLE.strip().splitlines())


def _arm(names: str, lengths: str, offsets: str, axes: str, height: str, mass: str) -> Arm:
    metres = [tuple(float(each) / 1000 for each in some.split() if each != "-") for some in (lengths, offsets)]
    known = None if height == "-" else float(height) / 1000, None if mass == "-" else float(mass)
    return Arm(tuple(names.split(",")), metres[0], metres[1], tuple(axes.split()), *known)


def called(text: str) -> list[Arm]:
    """The arms of which a text has a name, as a word of its own; the maker's in common where it names none of them."""
    said = re.sub(r"[^a-z0-9]+", "_", text.lower())
    named = [
        arm for arm in known_arms() if any(re.search(rf"(?<![a-z0-9]){name}(?![a-z0-9])", said) for name in arm.names)
    ]
    return [arm for arm in named if arm.lengths] or named


def differs(measured: float, right: float) -> bool:
    """Whether a length is another one than that of the data sheet."""
    return abs(measured - right) > max(NEAR, SHARE * right)


def rows_of_hinges(of: Simulation, count: int) -> Iterator[Measured]:
    """All rows of so many hinges, each carried by the one before, as the model stands where its joints are 0."""
    for joints in _chains(of):
        for first in range(len(joints) - count + 1):
            yield measured(of, joints[first : first + count])


@kept
def _chains(of: Simulation) -> tuple[tuple[int, ...], ...]:
    """The hinges from each last body back to the world, in order from the world on; each chain once."""
    parents = [int(parent) for parent in of.model("body_parentid")]
    found: dict[tuple[int, ...], None] = {}
    for last in range(1, of.count("body")):
        if last in parents:
            continue
        bodies = reversed([last, *of.ancestors(last)])
        found[tuple(joint for body in bodies for joint in of.joints_of(body) if of.joint_type(joint) == HINGE)] = None
    return tuple(found)


@kept
def measured(of: Simulation, joints: tuple[int, ...]) -> Measured:
    """The numbers of hinges in a row."""
    of.begin()
    places = [of.data_row("xanchor", joint, 3) for joint in joints]
    axes = [of.data_row("xaxis", joint, 3) for joint in joints]
    lengths, offsets, foot, shoulder = [], [], places[0], places[0]
    for one, (axis, after) in enumerate(pairwise(axes)):
        normal, between = cross(axis, after), sub(places[one + 1], places[one])
        sine = norm(normal)
        if sine < PARALLEL:
            start, end = foot, add(places[one + 1], after, dot(sub(foot, places[one + 1]), after))
        else:
            start = add(places[one], axis, dot(cross(between, after), normal) / sine**2)
            end = add(places[one + 1], after, dot(cross(between, axis), normal) / sine**2)
        shoulder = shoulder if one else start
        offsets.append(norm(sub(start, foot)))
        lengths.append(norm(sub(end, start)))
        foot = end
    return Measured(joints, shoulder, tuple(lengths), tuple(offsets[1:]), tuple(axes))


def direction(axis: Sequence[float]) -> str:
    """Along which axis of the world a direction lies: `-y`; empty where it lies along none."""
    size, which = max((abs(part), which) for part, which in zip(axis, "xyz", strict=True))
    return (("-" if axis["xyz".index(which)] < 0 else "") + which) if size > ALONG else ""


def about_the_vertical(axes: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """Directions, and how they are after a turn of all by 90, 180 and 270 degrees about z."""
    yield (turned := tuple(axes))
    for _ in range(3):
        yield (turned := tuple(QUARTER.get(axis, axis) for axis in turned))


def against(one: str, other: str) -> bool:
    """Whether two directions are opposite."""
    return one != other and one.strip("-") == other.strip("-")
