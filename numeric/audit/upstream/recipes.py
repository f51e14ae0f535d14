"""How an answer is compared with the truth, in words that need no code of ours.

RECIPES   what of an answer is compared -> how
MANNERS   checks of manners -> how they are made
REFUSAL, GROWTH   of the other checks
"""

from __future__ import annotations

PAIRS = (
    "Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least; "
    "each is within its bound."
)
ENTRIES = "Every entry differs from the true one by no more than its bound."
EXACT = "A bound is derived for exact comparison; comparing in floats adds rounding, which is far below it."
ANGLE = (
    "It spans a space of the true dimension, and the sine of the largest angle between the two, from either side, is within the bound; "
    "spaces of unlike dimensions have the sine 1."
)

RECIPES = {
    "markov": f"D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. {ENTRIES} {EXACT}",
    "transfer": f"D + C (z I - A)^-1 B of the answer at the z given. {ENTRIES} {EXACT}",
    "polynomial": f"The coefficients of det(z I - A) of the answer, of z^(n-1), ..., 1. {ENTRIES} {EXACT}",
    "eigenvalues": f"The eigenvalues of the answer's A, each as [re, im]. {PAIRS}",
    "residual": "Subtract the true r (N, p) from the answer; what is left may be a response to some initial state. For each kernel row "
    "with coefficients c_0, ..., c_d, each of length p, the norm over all t of c_0 off(t) + ... + c_d off(t + d), which such a response "
    "leaves at 0, is within the bound of that row.",
    "ranks": "All ranks are equal to the true ones.",
    "count": "The number is equal to the true one.",
    "space": f"The columns of the answer (n + p, n_z). {ANGLE}",
    "dimension": "The dimension is equal to the true one.",
    "responses": "Of the answer (A, C, Z), let f be the first n rows of Z and g the others: stack g, C f, C A f, ... over the window "
    f"given, the outputs over their units. {ANGLE}",
    "signal": "The 2-norm, over the first samples that are given, of the difference from the true v is within the bound; what comes after "
    "is free.",
    "normal_rank": "The number is equal to the true one.",
    "left_invertible": "It is true or false as it is to be.",
    "infinite_zero_orders": "In ascending order, they are equal to the true ones.",
    "finite_zeros": f"As many as there are true ones. {PAIRS}",
}
MANNERS = {
    "deterministic": "The question is asked twice, with copies of the same arguments. Both answers are the same in every bit.",
    "order-of-calls": "The question is asked, then another one, then the first again: both answers to it are the same in every bit.",
    "same-array-new-data": "An array that was asked about is filled with other data and asked about again: the answer is that to the "
    "new data.",
    "prints-nothing": "While it is asked, the function writes nothing to standard output.",
    "leaves-no-files": "While it is asked, the function leaves no file in the working folder, nor in that of temporary files.",
    "leaves-the-state": "What a process has one of is after the call as it was before: random numbers of numpy and of the language, "
    "handling of floating-point errors, filters of warnings, the working folder, the environment, threads, open files, signals, timers, "
    "hooks, the log, the context of decimals, the mask of files, limits, priority and processors, functions of libraries, and how "
    "processes are started.",
    "right-on-long-records": "On a record of the length given, made by signs through the system, some of them late or of many digits, the "
    "answer differs from the true one by no more than half of a unit in each quantity named.",
    "earlier-answers-stay": "An answer is kept while two other questions of the same shapes are asked: it is the same in every bit after "
    "them, and none of its arrays is one that was given.",
    "forgets-the-records": "Twenty records are asked about, one after another, and let go: of ten at least nothing is held any more. Three "
    "longer ones after that take less memory for good than half of what they are.",
    "inputs-untouched": "After the call every array that was given is as it was before.",
}
REFUSAL = "No answer is right. The function raises an error or answers nothing."
GROWTH = (
    "The function is asked about records of the lengths given, made by the recipe. With c1 and c2 the peak memory in bytes, or the CPU "
    "time in seconds, of the process and its children, log(c2 / max(c1, floor N1 / N2)) / log(N2 / N1) is within the bound, or c2 is "
    "below the floor. Time that grows faster is measured once more at twice the length, since data may outgrow a cache between two "
    "lengths, and the smaller exponent counts."
)
EITHER = " To refuse is an answer here, too: what cannot be told may stay untold."
FREE = " Nothing is due: whatever is answered is told, and counts neither for nor against."
