"""refuses-unexciting-input[n2-u1-p1-sine]-identify: one of many models that fit, without a word.

How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.

Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-unexciting-input[n2-u1-p1-sine]-identify'
--language python
"""

import base64
import sys
import zlib

import numpy as np

failed = False


def told(what, got, expected, off, bound):
    """Print one comparison; `off` and `bound` are arrays of one shape or numbers."""
    global failed
    off, bound = (np.atleast_1d(np.asarray(one, dtype=float)) for one in (off, bound))
    wrong = bool(np.any(~(off <= bound)))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(off == 0, 0.0, off / bound)
    failed = failed or wrong
    print(f"{what}: {'WRONG' if wrong else 'right'}")
    print("  got     ", np.array2string(np.asarray(got), threshold=40, prefix="  got      "))
    print("  expected", np.array2string(np.asarray(expected), threshold=40, prefix="  expected "))
    print(f"  off by {np.max(off, initial=0.0):.3g}, largest ratio to the bound {np.max(ratio, initial=0.0):.3g}")


def nearest(got, expected):
    """The numbers of `got` in the order of those of `expected` that they are nearest to; NaN where one is missing."""
    left, found = list(np.asarray(got, dtype=complex)), []
    for z in expected:
        found.append(left.pop(int(np.argmin(np.abs(np.array(left) - z)))) if left else np.nan)
    return np.array(found + ([np.nan] if left else []), dtype=complex)


def sine(got, expected):
    """The sine of the largest angle between the spaces of the columns, 1 where their dimensions differ."""
    spaces = []
    for columns in (got, expected):
        U, s, _ = np.linalg.svd(columns / (np.max(np.abs(columns), initial=0.0) or 1.0), full_matrices=False)
        spaces.append(U[:, s > 1e-12 * max(s, default=0.0)])
    P, Q = spaces
    return 1.0 if P.shape != Q.shape else np.linalg.norm(P - Q @ (Q.T @ P), 2)

# -- how sippy_unipi: MOESP, defaults (no D) is called
Array = object
import contextlib
import io
from types import SimpleNamespace
from typing import Any
from sippy_unipi import system_identification


def _identified(y: Array, u: Array, order: int, block_rows: int, **options: bool) -> tuple[Any, Any, Any, Any]:
    # It takes either orientation and guesses; a row a channel is that of its examples. Views, so that what it does to them is seen.
    with contextlib.redirect_stdout(io.StringIO()) as said:
        found = system_identification(y.T, u.T, "MOESP", SS_f=block_rows, SS_p=block_rows, SS_fixed_order=order, **options)
    if "Warning" in said.getvalue():  # printed, not raised
        raise ValueError(said.getvalue())
    return found.A, found.B, found.C, found.D



def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """It is called with its defaults."""
    return _identified(y, u, order, block_rows)



def _with_feedthrough(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    return _identified(y, u, order, block_rows, SS_D_required=True)

with_feedthrough = SimpleNamespace(identify=_with_feedthrough)

# -- the question
y = np.array([
    [-19.114285714285714], [51.07142857142857], [48.335], [28.48557142857143], [11.722529464285714], [3.5067959598214284],
    [2.51016914453125], [4.355716156682478], [4.767841862445243], [2.099446619793867], [-2.0551618614902636], [-4.55697317199246],
    [-3.4479157360226935], [0.3872071661857226], [3.8919233699964315], [4.272098466106274], [1.2294828902823385],
    [-2.798785131874943], [-4.588714687959395], [-2.707823961339055], [1.3393442587723292], [4.315086239284396],
    [3.838798241393342], [0.29149503141115474], [-3.488992279403446], [-4.4782804475347415], [-1.8849422118126273],
    [2.2163504198906345], [4.5445628163717], [3.237124910805761], [-0.6600129882617306], [-4.02914054276193],
    [-4.174955689151958], [-0.9808062969856647], [2.9979881273088096], [4.578392047770826], [2.4960823294734005],
    [-1.5830932524433718], [-4.3957942323222605], [-3.691859826261666], [-0.03443755913847047], [3.650534755324245],
    [4.4150792655410624], [1.6475603633305533], [-2.4380068295425183], [-4.573168558781139], [-3.0497954409948766],
    [0.9134140295871654], [4.145892276499376], [4.061656702212025], [0.7280957661550228], [-3.1879417828260115],
    [-4.553625905546243], [-2.276409303829481], [1.821934740950865], [4.462730992970519], [3.533342450613758],
    [-0.2227200522340093], [-3.800606513294569], [-4.338007763719474], [-1.405002803168799], [2.6520043999169145],
    [4.587408083069096], [2.8528852997660015], [-1.1639457233498949], [-4.249620167785875], [-3.9355984779931554],
    [-0.4730980058059112], [3.367880871026062], [4.514555051037186], [2.049585190218561], [-2.0550528227749125],
    [-4.515648577548456], [-3.3637254702832347], [0.4791780132085746], [3.938739086133524], [4.247308890151654],
    [1.158031582048461], [-2.857670991693501], [-4.587236772080662]
])
u = np.array([
    [1.0], [0.6], [-0.28], [-0.936], [-0.8432], [-0.07584], [0.752192], [0.9784704], [0.42197248], [-0.472103424],
    [-0.9884965888], [-0.71409248256], [0.131585609728], [0.8719952142336], [0.91480864735232], [0.225775162589184],
    [-0.6438784522452992], [-0.998429305283543], [-0.5542367140949525], [0.3333452483696001], [0.9542510121384725],
    [0.811755966196567], [0.019856147297407808], [-0.7879285894396776], [-0.9653704546250209], [-0.37051595611034754],
    [0.5207513072926039], [0.9954175248614722], [0.6737497225411627], [-0.18691785781207693], [-0.8980511519156551],
    [-0.8907435244867091], [-0.1708410774683959], [0.6857342315246341], [0.9937221552979568], [0.5067323548329141],
    [-0.38564332949845986], [-0.969504350231066], [-0.7777618907788192], [0.036190081296482844], [0.8211899883345987],
    [0.9492379047050356], [0.317895497311444], [-0.5677633079313027], [-0.9992114668290073], [-0.631290452263506],
    [0.24166292411280008], [0.9212859611988661], [0.8638802293258392], [0.11537031399214098], [-0.7254358525352701],
    [-0.985893337034465], [-0.45763615190608803], [0.4367299547471594], [0.9817120976026793], [0.7413245623760558],
    [-0.09212262275141242], [-0.8518717096777507], [-0.9301234288618884], [-0.2642764049565154], [0.6129917429140699],
    [0.9998664964533993], [0.5868480528300092], [-0.2956488330573882], [-0.9416266524988751], [-0.8343031499412619],
    [-0.05953712743063918], [0.7628585970244949], [0.974967443860033], [0.4071023356075448], [-0.4864446411309793],
    [-0.99083590496472], [-0.7025584448266846], [0.1477657711726984], [0.8798773702339227], [0.9080870731080088],
    [0.2098271174956879], [-0.6562945321131833], [-0.9973805560315079], [-0.5405621351246261]
])
order = 2
block_rows = 4

try:
    answer = identify(y, u, order, block_rows)
except (ValueError, ArithmeticError) as error:
    print(f"refused: {type(error).__name__}: {error}")
    answer = None
if answer is None:
    sys.exit(0)  # right: there is nothing to answer

print('WRONG: answered where no answer can be right')
print('  got', answer)
failed = True

sys.exit(1 if failed else 0)
