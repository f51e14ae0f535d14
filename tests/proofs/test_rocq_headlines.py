"""The headlines of the Rocq theory: closed, named by the ledger or by the README, and refused as soon as one word of them is changed."""

from __future__ import annotations

import re
from itertools import groupby
from pathlib import Path

import pytest

from faultspace.proofs.rocq import build as rocq_build
from faultspace.proofs.rocq import theorems as machine_checked
from faultspace.proofs.rocq.build import NotProved, compile_file, compiled_theory
from faultspace.proofs.rocq.sentences import refusals
from faultspace.proofs.rocq.sources import THEORY, sources
from faultspace.proofs.rocq.statements import Headline, read
from faultspace.proofs.rocq.theorems import asked, check
from faultspace.proofs.verdict.ledger import load
from tests.thorough import every

LONGEST_FILE, LONGEST_LINE = 400, 140

# For each headline one hypothesis, number or word of its statement and what it is changed to.
CHANGES: dict[str, tuple[str, str]] = {
    "words_are_ranks": ("word S s r", "word S s.+1 r"),
    "behaviors_are_words": ("forall s, ", "exists s, "),
    "blocks_of_window": ("k - i.+1", "k - i"),
    "zeros_exist": ("left_invertible S -> ", ""),
    "projected_limits_exist": ("white Q u H -> ", ""),
    "white_inputs_exist": ("white 1%:M u H", "white 1%:M u H.+1"),
    "assumption_2_one_sided": ("white Q u H -> a != 0 ->", "white Q u H ->"),
    "assumption_2_one_sided_windows": ("(1 < s)", "(0 < s)"),
    "assumption_2_without_lag_zero": ("B' = B", "B' <> B"),
    "assumption_2_two_sided": ("(t <= i < t + s)", "(t < i < t + s)"),
    "proposition_1_white_a_c": ("(i <= k)", "(i <= k.+1)"),
    "proposition_1_coloured_a_c": ("(i <= k < 4)", "(i <= k.+1 < 4)"),
    "proposition_1_two_sided": ("(t - q <= i < t + s)", "(t - q <= i < t)"),
    "proposition_1_two_sided_b_d": ("(O S s.-1)", "(O S s)"),
    "proposition_1_white_a_c_seen": ("(n <= q)", "(n <= q.+1)"),
    "proposition_1_white_b_d_seen": ("row_free (O S k)", "row_free (O S k.+1)"),
    "proposition_1_parametric": ("(q.-1 - j)", "(q - j)"),
    "proposition_1_autoregressive": ("(a <= s)", "(a <= s.+1)"),
    "proposition_1_lead_one": ("sysG S = 0 -> ", ""),
    "theorem_1_n_samples": ("word S n.+2 r /\\ ~ word S' n.+2 r", "word S n.+1 r /\\ ~ word S' n.+1 r"),
    "theorem_1": ("same_words S S' (maxn n n').+1", "same_words S S' (maxn n n')"),
    "theorem_1_lag": ("same_words S S' N.+1", "same_words S S' N"),
    "theorem_1_either_lag": ("\\rank (transfer S) = \\rank (transfer S') -> ", ""),
    "theorem_1_sharp": ("same_words S S' n", "same_words S S' n.+1"),
    "theorem_1_inclusion": ("(n <= N)", "(n <= N.+1)"),
    "theorem_2_finite_zeros_only": ("(1 + s * 1)", "(s * 1)"),
    "window_n_minus_1": ("+ 2)", "+ 1)"),
    "theorem_2": ("left_invertible S -> ", ""),
    "lag_at_most_n": ("<= n", "< n"),
    "assumption_4_excitation_at_s": ("r) + 1)", "r) + 0)"),
    "assumption_4_excitation_at_s_plus_1": ("row_full (excitation S x v N' s.+1)", "row_full (excitation S x v N' s)"),
    "assumption_4_excitation_necessary": ("(output S x v)) + 1)", "(output S x v)) + 2)"),
    "assumption_4_persistency_suffices": ("(n + s.+1)", "(n + s)"),
    "proposition_3_without_left_invertibility": ("+ 1)", "+ 0)"),
    "proposition_3": ("(n <= s)", "(n <= s.+1)"),
    "proposition_3_lag": ("left_invertible S -> ", ""),
    "lag_of_square_system": ("= 0%N", "= 1%N"),
    "proposition_3_normal_rank": ("(n <= s)", "(n <= s.+1)"),
    "normal_rank_of_pencil": ("(n + \\rank", "(m + \\rank"),
    "problem_11_window_n": ("solves S 1 f g", "solves S 2 f g"),
    "problem_11_first_block_column": ("~ solves S (lag S).+1", "~ solves S (lag S)"),
    "problem_11": ("(n < s)", "(n <= s)"),
    "problem_11_lag": ("solves S s.+1 f g", "solves S s f g"),
    "problem_11_full_rank": ("= p ->", "= m ->"),
    "problem_11_dimension": ("(m + (", "(n + ("),
    "theorem_3_part_i": ("spans_solutions S s Z -> ", ""),
    "theorem_3_almost_every": ("(lag S < s)", "(lag S <= s)"),
    "theorem_3_on_lines": ("(size ts <= m)", "(size ts < m)"),
    "theorem_3_every_p": ("~ same_behavior", "same_behavior"),
    "theorem_3_left_invertible": ("(lag S < s)", "(lag S <= s)"),
    "theorem_3_criterion": ("(lag S < s)", "(lag S <= s)"),
    "theorem_3": ("left_invertible S' ->", "left_invertible S ->"),
    "theorem_3_needs_same_A": ("sysC S = sysC S'", "sysA S = sysA S'"),
    "theorem_3_needs_left_invertibility": ("~ left_invertible S,", "left_invertible S,"),
    "zero_feedthrough_fault_matrices": ("~ (F' <= sysF S)", "(F' <= sysF S)"),
    "zero_feedthrough_matrices": ("(n < s)", "(n <= s)"),
    "zero_feedthrough": ("sysG S = 0 -> ", ""),
    "zero_feedthrough_recovery": ("\\rank (sysF S *m sysC S) = m -> ", ""),
    "trajectory_state_known": ("<-> left_invertible S", "<-> inverts_with_delay S 0"),
    "trajectory_state_unknown": ("~ (forall", "(forall"),
    "trajectory_no_finite_zeros": ("left_invertible S /\\ ", ""),
    "window_ranks": ("minn s e", "minn s.+1 e"),
    "window_ranks_left_indices": ("degree Y j", "(degree Y j).+1"),
    "window_ranks_indices": ("(size g).-1", "size g"),
    "window_ranks_zeros": ("left_invertible S -> ", ""),
    "zeta_of_system": ("(size g).-1", "size g"),
    "window_ranks_solutions": ("(e <= s)", "(e < s)"),
    "window_ranks_limit": ("(lag S <= s)", "(lag S < s)"),
    "solutions_closed_form": ("(n < s)", "(n <= s)"),
    "sharp_gap": ("(lag S <= s)", "(lag S < s)"),
    "sharp_equality": ("same_words S S' (lag S)", "same_words S S' (lag S).+1"),
    "sharp_equality_left_invertible": ("(lag S' <= lag S)", "(lag S' < lag S)"),
    "one_determinant": ("- map_mx polyC a", "+ map_mx polyC a"),
    "one_determinant_exists": ("row_free U", "row_full U"),
    "zeros_of_pairs": ("left_invertible S' -> ", ""),
    "zeros_of_pairs_split": ("F G : system _ 1 1 1)) 1", "F G : system _ 1 1 1)) 'X"),
    "bad_set_one_fault": ("row_free (O S n) -> ", ""),
    "bad_set_no_zeros": (" -> zeta S = 0%N", ""),
    "bad_set_full_rank": ("(1 < r)", "(2 < r)"),
    "bad_set_plane": ("row_free (O S n) -> ", ""),
    "zero_assignment": ("(size g <= e.+1)", "(size g <= e.+2)"),
    "recoverable_pair": ("\\rank (transfer S)", "m"),
    "canonical_form_same_a_c": ("(n < s)", "(n <= s)"),
    "canonical_form_exists": ("reduced_echelon R", "row_full R"),
    "canonical_form_any_a_c": ("c != 1 -> ", ""),
    "canonical_form_feedback": ("sysC S + L *m sysG S", "sysC S"),
    "canonical_form_feedback_no_basis": ("~ exists", "exists"),
    "left_invertible_delay": ("inverts_with_delay S n", "inverts_with_delay S n.-1"),
    "left_invertible_pencil": ("(n + m)%N", "n"),
    "left_invertible_transfer": ("= m", "= p"),
    "gap_meaning": ("window S s.+1", "window S s.+2"),
    "lag_meaning": ("(lag S <= s)", "(lag S < s)"),
    "chain_decreases": ("(j <= k)", "(k <= j)"),
    "chain_stays": ("(k <= j)", "(j <= k)"),
    "chain_constant": ("(n <= k)", "(n <= k.+1)"),
    "data_exact": ("kermx (window S s)", "0 : 'M_(n + s * m)"),
    "data_problem_11": ("(n + s.+1)", "(n + s)"),
    "noise_is_a_fault": ("sysG S + w k", "sysG S"),
    "whole_range_autoregressive": ("(n + a <= q <= t)", "(n <= q <= t)"),
    "whole_range_autoregressive_stationary": ("(a <= s)", "(a <= s.+1)"),
    "autoregressive_signals_exist": (" -> alpha * rho != 1", ""),
    "whole_range_controllable": ("row_free (O S s)", "row_free (O S s.+1)"),
    "whole_range_one_state": (" -> `|sysA S 0 0| < 1", ""),
    "one_state_signals_exist": ("cov Q (u 0%N) (u 1%N) != 0", "cov Q (u 0%N) (u 1%N) == 0"),
    "whole_range_seen": ("row_free (O S s)", "row_free (O S s.+1)"),
    "whole_range_almost_every": ("(size ts <= n * t)", "(size ts < n * t)"),
    "whole_range_somewhere": ("(n <= q)", "(n <= q.+1)"),
    "whole_range_nilpotent": ("iter q (mulmxr", "iter q.+1 (mulmxr"),
    "range_determines_a_c": ("O S s.-1", "O S s"),
    "white_a_c_up_to_basis": ("O S s.-1", "O S s"),
    "white_b_d_wrong_a_c_right": ("a + b != 0 -> ", ""),
    "coloured_a_c_stationary": ("(i < 3)", "(i < 4)"),
    "settle_1_not_both": ("O S s.-1", "O S s"),
    "settle_1_not_both_in_sum": ("k \\in ks -> ", ""),
    "settle_1_biased": ("0 < f ->", "0 <= f ->"),
    "settle_1_all_right": ("(2 < q <= t)", "(1 < q <= t)"),
    "behavior_is_kernel": ("(p - \\rank (transfer S))", "(p - m)"),
    "canonical_form_popov_rows": ("popov_rows S' N'", "popov_form N'"),
    "canonical_form_popov_rows_exist": ("popov_rows S N", "popov_rows S N /\\ d = p"),
    "canonical_form_popov_rows_minimal": ("popov_rows S N", "popov_form N"),
    "columns_after_change_of_state": ("invmx T *m sysC S'", "sysC S'"),
    "columns_after_map_of_state": ("same_behavior S S'", "(forall r, behavior S r -> behavior S' r)"),
    "zero_states_subspaces": ("largest_output_nulling S V", "output_nulling S V"),
    "zero_subspaces_exist": ("largest_output_nulling S V", "largest_output_nulling S V /\\ output_nulling S W"),
    "zero_states_direct": ("left_invertible S -> ", ""),
    "trajectory_zero_polynomial": ("left_invertible S /\\ ", ""),
    "unobservable_dynamics_exist": ("(N : 'M_(d, n))", "(N : 'M_(d.+1, n))"),
    "trajectory_multiplicity": ("~ (forall", "(forall"),
    "trajectory_multiplicity_delayed": ("~ (forall", "(forall"),
    "trajectory_delay": ("T S l.+1", "T S l.+2"),
    "infinite_zeros_by_ranks": ("left_invertible S -> ", ""),
    "delay_by_controllability": ("<= l +", "< l +"),
    "delay_any_state_exists": ("inverts_from_any_state", "inverts_with_delay"),
    "delay_any_state_longer": ("(l <= k)", "(k <= l)"),
    "delay_by_the_range": ("(exists l, inverts_from_any_state S l) -> ", ""),
    "delay_by_outputs": ("(m + n - ", "(m + n.-1 - "),
    "delay_bounds_attained": ("~ inverts_from_any_state", "inverts_from_any_state"),
    "zero_feedthrough_signal": ("\\rank (sysF S *m sysC S) = m /\\ ", ""),
    "sharp_equality_lag": ("(lag S' <= lag S)%N -> ", ""),
    "zero_assignment_observable": ("observable S -> ", ""),
    "zero_assignment_unobservable": ("char_poly M %| g /\\ ", ""),
    "minimal_basis_by_states": ("(p <= \\rank (sysG S) + k)", "(p <= \\rank (sysG S) + k.+1)"),
    "minimal_basis_seen": ("\\rank (Vocabulary.leading Y) = k -> ", ""),
    "check_window_ranks": ("minn s eta", "minn s.+1 eta"),
    "check_window_ranks_modulo": ("minn s eta", "minn s.+1 eta"),
    "check_left_invertible": ("-> left_invertible", "-> ~ left_invertible"),
    "check_left_invertible_at": ("-> left_invertible", "-> ~ left_invertible"),
    "check_solutions": ("(meant n m p L) s (", "(meant n m p L) s.+1 ("),
    "check_limit": ("(beyond < s)", "(beyond <= s)"),
    "check_inclusion": ("word S s r -> word S' s r", "word S' s r -> word S s r"),
    "check_equality": ("(forall s, same_words S S' s)", "(forall s r, word S s.+1 r <-> word S' s r)"),
    "check_window_equality": ("(meant n' m' p L') s", "(meant n' m' p L') s.+1"),
    "check_difference": ("(meant n' m' p L') s r", "(meant n' m' p L') s.-1 r"),
    "check_not_left_invertible": ("~ left_invertible", "left_invertible"),
    "check_delay": ("(j < l)", "(j <= l)"),
    "check_no_delay": ("(j <= n)", "(j <= n.+1)"),
    "check_observability": ("(meant n m p L) n)", "(meant n m p L) n.+1)"),
    "check_reachability": ("= r", "= r.+1"),
    "check_hankel": ("(hankel N s", "(hankel N.+1 s"),
    "check_excitation": (" N s) = r", " N.+1 s) = r"),
    "residues_mean": ("number K l = 0 -> ", ""),
    "residues_exist": ("Z.lt (Zpos xH) l -> ", ""),
    "algebraic_mean": ("value_at a f = 0 -> ", ""),
    "field_window_ranks": ("minn s eta", "minn s.+1 eta"),
    "field_left_invertible": ("-> left_invertible", "-> ~ left_invertible"),
    "field_not_left_invertible": ("~ left_invertible", "left_invertible"),
    "field_delay": ("(j < l)", "(j <= l)"),
    "field_no_delay": ("(j <= n)", "(j <= n.+1)"),
    "field_inclusion": ("word S s r -> word S' s r", "word S' s r -> word S s r"),
    "field_equality": ("(forall s, same_words S S' s)", "(forall s r, word S s.+1 r <-> word S' s r)"),
    "field_window_equality": ("(system_of value n' m' p L') s", "(system_of value n' m' p L') s.+1"),
    "field_difference": ("(system_of value n' m' p L') s r", "(system_of value n' m' p L') s.-1 r"),
    "field_solutions": ("(system_of value n m p L) s (", "(system_of value n m p L) s.+1 ("),
    "field_limit": ("(beyond < s)", "(beyond <= s)"),
    "field_observability": ("(system_of value n m p L) n)", "(system_of value n m p L) n.+1)"),
    "field_window": ("= r", "= r.+1"),
    "field_toeplitz": ("= r", "= r.+1"),
    "field_reachability": ("= r", "= r.+1"),
    "field_hankel": ("(hankel N s", "(hankel N.+1 s"),
    "field_excitation": (" N s) = r", " N.+1 s) = r"),
    "field_finite_zeros": ("\\rank (transfer S) = r", "\\rank (transfer S) = r.+1"),
    "field_infinite_zeros": ("(take j orders)", "(take j.+1 orders)"),
    "field_left_invertible_line": ("(a != 0) || (b != 0)", "true"),
    "field_schur_stable": ("means value -> ", ""),
    "field_moesp_limit": ("\\rank (col_mx L seen) = rj", "\\rank (col_mx L seen) = rl"),
    "field_input_limit_moesp": (
        "exists X, forall B' D' X', squares (rest B0 D0 X) <=",
        "exists X, forall B' D' X', squares (rest B0 D0 X) <",
    ),
    "field_input_limit_true_AC": ("cov Q (z1 1%N) (z 1%N) = cov Q (z1 0%N) (z 0%N) -> ", ""),
    "means_exist": ("period_average (fun=> 1 : K) 1", "period_average (fun=> 1 : K) 0"),
    "mean_two_sided": ("uncorrelated E u v -> ", ""),
    "mean_two_sided_b_d": ("(O S s.-1)", "(O S s)"),
    "mean_autoregressive": ("(a <= s)", "(a <= s.+1)"),
    "mean_past_states": ("positive E -> ", ""),
    "mean_long_past": ("(n + r <= q)", "(n + r <= q.+1)"),
    "filtered_inputs": ("(later 1 e) u", "e u"),
    "mean_two_states": ("excites E s.+3 u", "excites E s.+2 u"),
    "prediction_errors_exist": ("excites E r u -> ", ""),
    "mean_output_error": ("excites E n.+1 u", "excites E n u"),
    "mean_signals_exist": ("order_of_spectrum E 2 u", "order_of_spectrum E 1 u"),
    "mean_noise": ("uncorrelated E u w -> ", ""),
    "mean_noise_range": ("(n + r <= q)", "(n + r <= q.+1)"),
    "mean_noise_output_error": ("excites E n.+1 u", "excites E n u"),
    "mean_noise_past_outputs": ("uncorrelated E u w -> ", ""),
    "mean_past_outputs": ("knows_nothing_before E (later 1 v) v -> ", ""),
    "white_signals_exist": ("white_noise E u, ", "white_noise E (later 1 u), "),
    "mean_coloured_fault": ("sysG S = 0 -> ", ""),
    "coloured_fault_exists": ("sysF S != 0 -> ", ""),
    "mean_neither_right": ("~ (L <= O S 2)", "(L <= O S 2)"),
    "mean_settle_1_not_both": ("(0 < q)%N -> ", ""),
    "mean_settle_1_signals_exist": ("stable (sysA S) -> ", ""),
    "example_v_ranks": ("minn s 2", "minn s 3"),
    "example_v_columns": ("(2 < s)", "(2 <= s)"),
    "example_v_controllability": ("example_root a -> ", ""),
    "example_v_zeros": ("inverts_with_delay S 1 ", "inverts_with_delay S 2 "),
    "example_v_data": ("N 6)", "N 5)"),
    "example_roots_exist": ("(2%:R : 'F_23)", "(3%:R : 'F_23)"),
    "time_averages": ("archimedean K -> ", ""),
    "time_averages_white": ("uncorrelated E u v", "uncorrelated E u u"),
    "time_averages_exist": ("stable (sysA S) -> ", ""),
    "noisy_signals_exist": ("stable (sysA S) -> ", ""),
    "mean_part_of_the_range": ("~ (O S 2 <= L)", "(O S 2 <= L)"),
    "mean_rational_range": ("row_free (O S s)", "row_free (O S s.+1)"),
    "mean_rational_order": ("(r' <= r)", "(r' < r)"),
    "rational_almost_every": ("(size ts <= n * (q + r))", "(size ts < n * (q + r))"),
    "mean_rational_somewhere": ("(n <= q)", "(n <= q.+1)"),
}


STATEMENTS = read(sources())
FILES = ["Headlines.v", *(f"{name}.v" for name in re.findall(r"^Include (\w+)\.", sources()["Headlines.v"], re.MULTILINE))]
HEADLINES = [one for file in FILES for one in STATEMENTS.headlines.values() if one.file == file]


def in_part(headlines: list[Headline]) -> list[Headline]:
    """Returns the headlines of every file that are tried, file by file; all of them in a thorough run."""
    by_file = sorted(headlines, key=lambda h: h.file)
    return [h for _, of_file in groupby(by_file, key=lambda h: h.file) for h in [*of_file][:: every()]]


# (a) closed, and what the ledger names


@pytest.mark.programs
@pytest.mark.timeout(900)
def test_every_headline_is_closed(theory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    names = {h.name for h in HEADLINES}
    assert len(names) == len(HEADLINES) > 90
    of_the_ledger = {name for claim in load() for reading in claim.readings for name in reading.theorems}
    assert set(check(of_the_ledger).statements) == of_the_ledger  # what the main job asks, so that one of them finds the answer kept
    others = [h.name for h in in_part([h for h in HEADLINES if h.name not in of_the_ledger])]
    monkeypatch.setattr(machine_checked, "_same_vocabulary", lambda theory, texts: None)  # it was compared for the question before
    assert set(check(others).statements) == {*others}


def test_every_theorem_of_the_ledger_is_a_headline() -> None:
    named = {name for claim in load() for reading in claim.readings for name in reading.theorems}
    assert named <= {h.name for h in HEADLINES}


# (b) one word changed, and the same proof is refused


def test_every_headline_has_a_change() -> None:
    assert len(HEADLINES) == len(STATEMENTS.headlines), "Headlines.v includes all files of headlines"
    assert list(CHANGES) == [h.name for h in HEADLINES]
    for headline in HEADLINES:
        old, new = CHANGES[headline.name]
        assert headline.statement.count(old) == 1 and old != new, headline.name


def replay(about: list[Headline]) -> str:
    """Returns a file in which each headline is proved as it is, and its changed copy is well-formed but refused by the same proof. Each of
    our files is a module, since what it opens with is for its own headlines."""
    lines = []
    for part in sorted({h.file for h in about}):
        opening = re.split(r"^(?:\(\*\* \*\*|Theorem )", sources()[part], maxsplit=1, flags=re.MULTILINE)[0]
        lines += [f"Module In{part.removesuffix('.v')}.", opening]
        for h in about:
            if h.file == part:
                changed = h.statement.replace(*CHANGES[h.name])
                lines += [f"Theorem kept_{h.name}{h.statement}.\nProof. {h.tactics} Qed."]
                lines += [f'Goal True. idtac "== {h.name}". Abort.']
                lines += [f"Theorem changed_{h.name}{changed}.\nProof. Timeout 100 Fail ({h.tactics[:-1]}). Abort."]
        lines += [f"End In{part.removesuffix('.v')}."]
    return "\n".join(lines) + "\n"


@pytest.mark.programs
@pytest.mark.mutants
@pytest.mark.timeout(900)
def test_a_changed_headline_is_refused(theory: Path) -> None:
    about = in_part(HEADLINES)
    assert {h.file for h in about} == {*FILES}
    said = compile_file(theory, "Replay.v", replay(about))
    assert said.split("\n") == [*(f"== {h.name}" for h in about), ""]


@pytest.mark.programs
@pytest.mark.timeout(900)
def test_the_replay_notices_a_change_that_changes_nothing(theory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    about = [h for h in HEADLINES if h.name == "proposition_3"]
    monkeypatch.setitem(CHANGES, "proposition_3", ("(n <= s)%N", "((n <= s)%N)"))
    with pytest.raises(rocq_build.BrokenTheory, match="has not failed"):
        compile_file(theory, "Replay.v", replay(about))


# (c), (d) nothing assumed, nothing switched off, files of readable size


def test_no_file_assumes_anything() -> None:
    assert refusals(sources()) == {}


def test_files_are_short_and_say_what_they_are() -> None:
    for name, text in sources().items():
        lines = text.splitlines()
        assert text.startswith("(** "), f"{name} has no head comment"
        assert len(lines) <= LONGEST_FILE, f"{name} has {len(lines)} lines"
        assert "\t" not in text, f"{name} has a tab"
        long = [k for k, line in enumerate(lines, 1) if len(line) > LONGEST_LINE]
        assert not long, f"{name}: long lines {long}"


# (e) what machine_checked refuses

TINY = {
    "Vocabulary.v": "Definition one := 1.\n",
    "Proofs.v": "From faultspace Require Import Vocabulary.\nLemma good : one = 1.\nProof. reflexivity. Qed.\n",
    "Headlines.v": "From faultspace Require Import Vocabulary.\nFrom faultspace Require Proofs.\n"
    "Theorem good : one = 1.\nProof. exact Proofs.good. Qed.\n",
}
BAD = "Theorem bad : one = 2.\nProof. exact Proofs.bad. Qed.\n"


def tiny(proofs: str = "", headlines: str = "") -> dict[str, str]:
    """Returns a theory of three files, with these lines added."""
    return {**TINY, "Proofs.v": TINY["Proofs.v"] + proofs, "Headlines.v": TINY["Headlines.v"] + headlines}


@pytest.mark.programs
def test_a_closed_theorem_passes(theory: Path) -> None:
    assert asked(["good"], tiny(), compiled_theory(texts=tiny())) == {"good": "one = 1"}


@pytest.mark.programs
@pytest.mark.parametrize(
    ("proofs", "headlines", "names", "reason"),
    [
        ("Theorem bad : one = 2.\nAdmitted.\n", BAD, ["bad"], "rest on more"),
        ("Theorem bad : one = 2.\nAdmitted.\n", BAD, ["bad", "good"], "rest on more"),
        ("Axiom absurd : one = 2.\nTheorem bad : one = 2.\nProof. exact absurd. Qed.\n", BAD, ["bad"], "rest on more"),
        ("", "", ["missing"], "missing, which is in no file theory/headlines/Headlines"),
    ],
)
def test_machine_checked_refuses(theory: Path, proofs: str, headlines: str, names: list[str], reason: str) -> None:
    """Rocq itself refuses, whatever the text of the sources may look like."""
    texts = tiny(proofs, headlines)
    with pytest.raises(NotProved, match=reason):
        asked(names, texts, compiled_theory(texts=texts))


# README


ON_CERTIFICATES = ("HeadlinesChecks.v", "HeadlinesFields.v", "HeadlinesExperiments.v")


def test_the_readme_names_every_headline_that_no_reading_names() -> None:
    """Those on certificates have files of their own, which it names."""
    _, _, section = THEORY.joinpath("README.md").read_text("utf-8").partition("## What no reading names")
    section = section.partition("\n## ")[0]
    named = re.findall(r"`(\w+)`", " ".join(re.findall(r"^\| .* \| .* \| (`.*`) \|$", section, re.MULTILINE)))
    by_readings = {name for claim in load() for reading in claim.readings for name in reading.theorems}
    assert all(f"`{file}`" in section for file in ON_CERTIFICATES)
    assert sorted(named) == sorted({one.name for one in HEADLINES if one.file not in ON_CERTIFICATES} - by_readings)
