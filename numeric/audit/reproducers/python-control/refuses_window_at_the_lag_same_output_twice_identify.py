"""refuses-window-at-the-lag[same-output-twice]-identify: A is not determined by so short a window: made-up poles.

How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.

Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-window-at-the-lag[same-output-twice]-identify'
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

# -- how python-control: markov, eigensys_realization; StateSpace.zeros is called
Array = object
class Refused(ValueError):
    pass
import sys
import warnings
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch
import control
LONGEST = 100


def _taken(samples: int, n_u: int, order: int) -> int:
    """Return the number m of Markov parameters."""
    return max(min(samples // (2 * n_u), LONGEST), 4 * order + 1)



def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """The number m of Markov parameters is two equations an unknown, at most LONGEST, never fewer than eigensys_realization's default
    Hankel matrix takes (the default m, as many as samples, is right for a single input at rest alone).
    """
    n_u, p = u.shape[1], y.shape[1]
    m = _taken(len(u), n_u, order)
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)  # "Not enough data for requested number of parameters"
        try:
            response = control.markov(y.T, u.T, m)
        except UserWarning as warning:
            raise ValueError(str(warning)) from warning
    found, _ = control.eigensys_realization(response.reshape(p, n_u, m), order)
    return found.A, found.B, found.C, found.D



def structure(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    """Return the zeros, found by slycot where that is installed, else of square systems alone."""
    try:
        return {"finite_zeros": [complex(z) for z in control.StateSpace(A, F, C, G, True).zeros()]}
    except NotImplementedError as lacking:
        raise Refused(str(lacking)) from lacking



def _without_slycot(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    # The package imports slycot where it needs it, and takes a module of None for one that is not installed.
    with patch.dict(sys.modules, {"slycot": None}):
        return structure(A, F, C, G)

without_slycot = SimpleNamespace(structure=_without_slycot)

# -- the question
y = np.array([
    [1.0, 2.0], [4.0, 8.0], [0.14583333333333334, 0.2916666666666667], [-2.1375, -4.275], [-0.4702951388888889,
    -0.9405902777777778], [-3.404215277777778, -6.808430555555556], [-3.427625824652778, -6.855251649305556],
    [-1.4395507725694445, -2.879101545138889], [-3.1113439245876737, -6.2226878491753475], [0.5704860029513888,
    1.1409720059027777], [1.478063930496148, 2.956127860992296], [2.7479547559071724, 5.495909511814345], [3.109026651227126,
    6.218053302454252], [4.2454397202816905, 8.490879440563381], [1.8756764556061023, 3.7513529112122046], [-0.9778841664375704,
    -1.9557683328751407], [-0.15829408959449512, -0.31658817918899024], [1.3951091729279088, 2.7902183458558176],
    [1.1746945235838766, 2.349389047167753], [3.0903021521309983, 6.180604304261997], [-1.0953629263604334, -2.190725852720867],
    [-2.3970191790978865, -4.794038358195773], [0.02809436935044556, 0.05618873870089112], [-0.6951634992782144,
    -1.3903269985564288], [-1.3511860398973563, -2.7023720797947126], [-0.4606182786345621, -0.9212365572691242],
    [2.412959859047699, 4.825919718095398], [3.233280682274978, 6.466561364549956], [4.078395137442257, 8.156790274884514],
    [1.8350500286774853, 3.6701000573549707], [0.6806292357826785, 1.361258471565357], [2.8839694171099217, 5.767938834219843],
    [2.640520332874515, 5.28104066574903], [3.2470182893058896, 6.494036578611779], [2.9234033651382485, 5.846806730276497],
    [-1.302091425409824, -2.604182850819648], [-1.307815292043523, -2.615630584087046], [0.33065621539144757, 0.6613124307828951],
    [-2.500449029557182, -5.000898059114364], [1.4927058428349884, 2.985411685669977], [1.2795042636231186, 2.5590085272462373],
    [1.8974486408808204, 3.794897281761641], [2.858930993571767, 5.717861987143534], [2.4049104469778118, 4.8098208939556235],
    [4.419836497778451, 8.839672995556901], [5.29719260257847, 10.59438520515694], [4.516771820918821, 9.033543641837642],
    [0.3037769796144948, 0.6075539592289896], [-3.0664608672445697, -6.132921734489139], [0.1357483849504028, 0.2714967699008056],
    [-0.729888015704102, -1.459776031408204], [-0.050979359223678335, -0.10195871844735667], [-2.9758455711828837,
    -5.9516911423657675], [-2.812727987021054, -5.625455974042108], [-0.08667227247885008, -0.17334454495770016],
    [1.7015260181747398, 3.4030520363494796], [-0.7839891821781618, -1.5679783643563237], [1.9289861022639456,
    3.8579722045278912], [2.497923154718964, 4.995846309437928], [-0.4373191378558727, -0.8746382757117453], [0.6767041602820915,
    1.353408320564183], [1.9672912476595796, 3.9345824953191593], [0.8532728355975985, 1.706545671195197], [-1.8197931294685636,
    -3.6395862589371273], [-2.542542825071766, -5.085085650143532], [-3.001188970119742, -6.002377940239484],
    [-3.1898884146639728, -6.3797768293279455], [0.773556545244837, 1.547113090489674], [3.297733578398829, 6.595467156797658],
    [-0.7496465723869937, -1.4992931447739875], [-0.06076150616043442, -0.12152301232086885], [-1.8159449237275935,
    -3.631889847455187], [-0.1837354362289656, -0.3674708724579312], [0.5341694335783836, 1.0683388671567673],
    [-2.2699954930382362, -4.5399909860764724], [-2.7036843355635596, -5.407368671127119], [-1.369885145117749,
    -2.739770290235498], [1.5304568850756914, 3.060913770151383], [-1.9192547608979353, -3.8385095217958707], [-4.078638243804229,
    -8.157276487608458], [-4.898427605620986, -9.796855211241972], [-1.3744311160183031, -2.7488622320366063],
    [-3.388232526023417, -6.776465052046834], [-2.87041258739781, -5.74082517479562], [-0.9744834355970698, -1.9489668711941397],
    [-1.1183915378849032, -2.2367830757698064], [-1.1998256492085264, -2.399651298417053], [-0.9830758861645913,
    -1.9661517723291826], [1.1180978884818316, 2.236195776963663], [-0.24055635634909306, -0.4811127126981861]
])
u = np.array([
    [3.0], [-2.6666666666666665], [-2.3333333333333335], [1.0], [-3.0], [-1.3333333333333333], [0.6666666666666666],
    [-2.3333333333333335], [2.3333333333333335], [1.0], [1.6666666666666667], [1.3333333333333333], [2.3333333333333335],
    [-0.6666666666666666], [-2.0], [0.6666666666666666], [1.6666666666666667], [0.3333333333333333], [2.3333333333333335], [-3.0],
    [-1.6666666666666667], [1.6666666666666667], [-0.6666666666666666], [-1.0], [0.3333333333333333], [2.6666666666666665],
    [1.6666666666666667], [2.0], [-0.6666666666666666], [-0.3333333333333333], [2.6666666666666665], [1.0], [1.6666666666666667],
    [1.0], [-3.0], [-0.3333333333333333], [1.3333333333333333], [-2.6666666666666665], [3.0], [0.3333333333333333], [1.0],
    [1.6666666666666667], [0.6666666666666666], [3.0], [2.6666666666666665], [1.3333333333333333], [-2.3333333333333335], [-3.0],
    [2.3333333333333335], [-0.6666666666666666], [0.3333333333333333], [-3.0], [-1.0], [1.6666666666666667], [1.6666666666666667],
    [-2.0], [2.3333333333333335], [1.3333333333333333], [-2.0], [1.0], [1.6666666666666667], [-0.3333333333333333],
    [-2.3333333333333335], [-1.3333333333333333], [-1.3333333333333333], [-1.3333333333333333], [2.6666666666666665],
    [2.6666666666666665], [-3.0], [0.3333333333333333], [-1.6666666666666667], [1.0], [0.6666666666666666], [-2.6666666666666665],
    [-1.3333333333333333], [0.3333333333333333], [2.3333333333333335], [-3.0], [-3.0], [-2.3333333333333335],
    [1.6666666666666667], [-2.6666666666666665], [-1.0], [0.6666666666666666], [-0.6666666666666666], [-0.6666666666666666],
    [-0.3333333333333333], [1.6666666666666667], [-1.0], [-2.3333333333333335]
])
order = 3
block_rows = 3

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
