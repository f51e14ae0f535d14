"""This is the ladder benchmark in the languages of Macaulay2 and Singular: scripts that speak the protocol of `ladder_methods`.

macaulay2_ranks     rank of every window, built there from A, F, C, G
macaulay2_kernel    degrees of minimal generators of the left kernel of the pencil [[qI - tA, -tF], [tC, tG]]: the left minimal indices
singular_ranks      rank of every window
"""

from __future__ import annotations

from benchmarks.ladder_systems import Rows

# Over ZZ the rank of Macaulay2 1.21 is a Groebner basis, which took 11 GB for a 100 x 100 matrix of rank 60; over QQ it is an elimination.
_MACAULAY2_RANKS = """
markov = {G}; X = F;
scan(n, k -> (markov = append(markov, C*X); X = A*X));
O = C; row = C;
scan(n, k -> (row = row*A; O = O || row));
Z = map(QQ^p, QQ^m, 0);
T = matrix apply(n+1, i -> apply(n+1, j -> if j <= i then markov_(i-j) else Z));
W = O | T;
built = apply(1..n+1, s -> mutableMatrix W^(toList(0..p*s-1))_(toList(0..n+m*s-1)));
start = cpuTime();
<< "ready " << start << endl << flush;
scan(n+1, i -> << "rank " << i+1 << " " << rank built_i << endl << flush);
<< "seconds " << cpuTime() - start << endl << flush;
exit 0
"""

_MACAULAY2_KERNEL = """
R = QQ[q,t];
up = M -> sub(M, R);
P = (q*id_(R^n) - t*up A | -t*up F) || (t*up C | t*up G);
-- transposed, so that left null vectors are columns; graded, so that minimal generators exist
M = map(R^(n+m), R^{n+p:-1}, transpose P);
start = cpuTime();
<< "ready " << start << endl << flush;
K = mingens ker M;
<< "indices";
scan(sort flatten degrees source K, d -> << " " << d-1);
<< endl << "seconds " << cpuTime() - start << endl << flush;
exit 0
"""

_SINGULAR_RANKS = """
LIB "matrix.lib";
matrix W[p*(n+1)][n+m*(n+1)];
matrix X = C; matrix M = G;
int k, i, j, s;
for (k = 0; k <= n; k++)
{
  for (i = 1; i <= p; i++)
  {
    for (j = 1; j <= n; j++) { W[p*k+i, j] = X[i,j]; }
    for (j = 1; j <= m; j++) { for (s = 0; s + k <= n; s++) { W[p*(k+s)+i, n+m*s+j] = M[i,j]; } }
  }
  M = X*F; X = X*A;
}
list built;
for (s = 1; s <= n+1; s++) { built[s] = submat(W, 1..p*s, 1..(n+m*s)); }
system("--ticks-per-sec", 1000);
int start = timer;
"ready " + string(start div 1000) + "." + string(1000 + start mod 1000)[2,3];
for (s = 1; s <= n+1; s++) { "rank " + string(s) + " " + string(rank(built[s])); }
int spent = timer - start;
"seconds " + string(spent div 1000) + "." + string(1000 + spent mod 1000)[2,3];
quit;
"""


def macaulay2_ranks(system: dict[str, Rows]) -> str:
    """This writes the script."""
    return _macaulay2_matrices(system) + _MACAULAY2_RANKS


def macaulay2_kernel(system: dict[str, Rows]) -> str:
    """This writes the script."""
    return _macaulay2_matrices(system) + _MACAULAY2_KERNEL


def singular_ranks(system: dict[str, Rows]) -> str:
    """This writes the script."""
    lines = ["ring r = 0, (q,t), (c,dp);", *(f"int {name} = {value};" for name, value in _sizes(system).items())]
    for name, rows in system.items():
        entries = ",".join(str(x) for row in rows for x in row)
        lines.append(f"matrix {name}[{len(rows)}][{len(rows[0])}] = {entries};")
    return "\n".join(lines) + _SINGULAR_RANKS


def _macaulay2_matrices(system: dict[str, Rows]) -> str:
    lines = [f"{name} = {value};" for name, value in _sizes(system).items()]
    for name, rows in system.items():
        entries = ",".join("{" + ",".join(map(str, row)) + "}" for row in rows)
        lines.append(f"{name} = matrix{{{entries}}} ** QQ;")
    return "\n".join(lines) + "\n"


def _sizes(system: dict[str, Rows]) -> dict[str, int]:
    return {"n": len(system["A"]), "m": len(system["F"][0]), "p": len(system["C"])}
