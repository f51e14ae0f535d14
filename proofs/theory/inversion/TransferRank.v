(** The pencil [qI - A, C; -F, G] over the rational functions: q I - A is invertible and the Schur complement is the transfer matrix, so
    rank of the pencil = n + rank of the transfer matrix, without any hypothesis. Hence left-invertibility is full row rank m of the
    transfer matrix. *)
From mathcomp Require Import ssreflect ssrbool ssrfun eqtype ssrnat seq choice fintype bigop zmodp ssralg poly matrix mxalgebra mxpoly
  fraction.
From faultspace Require Import Vocabulary Inversion.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section TransferRank.
Variables (K : fieldType) (n m p : nat).
Implicit Types S : system K n m p.
Notation over := (@over_fractions K _ _).

Lemma resolvent_unit S : over ('X%:M - map_mx polyC (sysA S)) \in unitmx.
Proof.
rewrite unitmxE /over_fractions det_map_mx unitfE tofrac_eq0.
exact/monic_neq0/char_poly_monic.
Qed.

Theorem pencil_rank_transfer S : \rank (over_fractions (pencil S)) = (n + \rank (transfer S))%N.
Proof.
rewrite /over_fractions /pencil map_block_mx /transfer map_mxN -!/(over _).
move: (resolvent_unit S); set D := over ('X%:M - _) => D_unit.
set C := over (map_mx polyC (sysC S)); set F := over (map_mx polyC (sysF S)).
set G := over (map_mx polyC (sysG S)); set H := F *m invmx D *m C + G.
have -> : block_mx D C (- F) G = block_mx 1%:M 0 (- (F *m invmx D)) 1%:M *m (block_mx D 0 0 H *m block_mx 1%:M (invmx D *m C) 0 1%:M).
  rewrite !mulmx_block !mul1mx !mulmx1 !mulmx0 !mul0mx !addr0 !add0r.
  by rewrite mulKVmx // !mulNmx mulmxKV // /H addKr.
have unit_lower (X : 'M[{fraction {poly K}}]_(m, n)) : row_full (block_mx 1%:M 0 X 1%:M).
  by rewrite row_full_unit unitmxE det_lblock !det1 mulr1 unitr1.
have unit_upper (Y : 'M[{fraction {poly K}}]_(n, p)) : row_free (block_mx 1%:M Y 0 1%:M).
  by rewrite row_free_unit unitmxE det_ublock !det1 mulr1 unitr1.
by rewrite (eqmxMfull _ (unit_lower _)) mxrankMfree // rank_diag_block_mx mxrank_unit.
Qed.

Theorem left_invertible_transfer_rank S : left_invertible S <-> \rank (transfer S) = m.
Proof. by rewrite left_invertible_pencil_rank pencil_rank_transfer; split=> [/addnI | ->]. Qed.

End TransferRank.
