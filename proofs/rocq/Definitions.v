(** The earlier name of Vocabulary.v, for files that still import it. *)
From faultspace Require Export Vocabulary.
