% refuses-short-residual[two-faults]-window_ranks: ranks of windows longer than the record.
%
% How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.
%
% Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-short-residual[two-faults]-window_ranks'
% --language octave

failed = false;
% -- how ggleizer/fault_id: PI-MOESP; rank and threshold of its exact example is called
1;
% Called as total_pipeline_example does: without THRESHOLD as for the true system (rank's own tolerance), with it as for the identified
% one (rank(R, 1.0)). Bases are cut at the example's 1e-10 in either.
global folder = getenv("FAULT_ID"); global threshold = str2double([argv(){:} ""]);

% MATLAB's qr(X, "econ") is qr(X, 0) in Octave, and svds there knows no "smallest": the last singular vectors by a full decomposition.
function [Q, R] = qr(X, varargin), [Q, R] = builtin("qr", X, 0); end
function [U, S, V] = svds(M, k, varargin), [U, S, V] = svd(M); V = V(:, end-k+1:end); end

function k = rank_of(R)
  global threshold
  if isnan(threshold), k = rank(R); else, k = rank(R, threshold); end
end

function a = identify(q), [a.A, a.B, a.C, a.D] = pi_moesp(q.u, q.y, q.block_rows, q.order); end

function a = asked_window_ranks(q), a.ranks = arrayfun(@(s) rank_of(blkhankel(q.r, s)), 1:q.windows); end

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
function answer = window_ranks(r, windows)
  answer = asked_window_ranks(struct("r", r, "windows", windows)).ranks;
end

% -- the question
r = [
  -9.438095238095238 11.371428571428572 -10.447619047619048
  -14.676785714285714 -11.483134920634921 -6.147420634920635
  -3.8614335317460315 0.09563492063492063 9.845560515873016
  16.268854631696428 5.347762431795635 3.181844463045635
  -9.78511977422805 -13.872088283962674 -12.88555438329303
];
windows = 8;

try
  answer = window_ranks(r, windows);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', 'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nright: there is nothing to answer\n', problem.message); exit(0);
end

disp('WRONG: answered where no answer can be right'); failed = true;

exit(double(failed));
