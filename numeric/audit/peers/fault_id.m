1;  % octave-cli --quiet fault_id.m [THRESHOLD]: functions of a clone of ggleizer/fault_id, in the folder FAULT_ID, behind JSON lines.
% Called as total_pipeline_example does: without THRESHOLD as for the true system (rank's own tolerance), with it as for the identified
% one (rank(R, 1.0)). Bases are cut at the example's 1e-10 in either.
global folder = getenv("FAULT_ID"); global threshold = str2double([argv(){:} ""]);
source(fullfile(fileparts(mfilename("fullpath")), "json_lines.m"));

% MATLAB's qr(X, "econ") is qr(X, 0) in Octave, and svds there knows no "smallest": the last singular vectors by a full decomposition.
function [Q, R] = qr(X, varargin), [Q, R] = builtin("qr", X, 0); end
function [U, S, V] = svds(M, k, varargin), [U, S, V] = svd(M); V = V(:, end-k+1:end); end

function k = rank_of(R)
  global threshold
  if isnan(threshold), k = rank(R); else, k = rank(R, threshold); end
end

function a = identify(q), [a.A, a.B, a.C, a.D] = pi_moesp(q.u, q.y, q.block_rows, q.order); end

function a = window_ranks(q), a.ranks = arrayfun(@(s) rank_of(blkhankel(q.r, s)), 1:q.windows); end

function a = fault_dimension(q)
  global threshold
  if isnan(threshold), s = 20; else, s = 5; end  % "Large value" of either branch
  a.n_v = rank_of(blkhankel(q.r, s + 1)) - rank_of(blkhankel(q.r, s));
end

function a = fault_space(q)
  s = q.block_rows; [U, S, ~] = svd(blkhankel(q.r, s), "econ");
  U = U(:, 1:sum(diag(S) > 1e-10));
  a.basis = estimate_input_matrices(U, extended_obs(q.A, q.C, s), rows(q.C), q.n_v);
end

if isempty(folder) || ! exist(fullfile(folder, "pi_moesp.m"), "file")
  fprintf(stderr, "set FAULT_ID to the folder of a clone of ggleizer/fault_id: got '%s', which has no pi_moesp.m\n", folder); exit(1);
end
addpath(folder);
answer_questions(struct("identify", @identify, "window_ranks", @window_ranks, "fault_dimension", @fault_dimension, "fault_space", @fault_space));
