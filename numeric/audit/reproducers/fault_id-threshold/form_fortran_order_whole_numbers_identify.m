% form-fortran-order[whole-numbers]-identify: a wrong answer for the same numbers: fortran-order.
%
% How it is compared: D, C B, C A B, C A^2 B, ... of the answer (A, B, C, D), as many as are given. Every entry
% differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
% floats adds rounding, which is far below it. D + C (z I - A)^-1 B of the answer at the z given. Every entry
% differs from the true one by no more than its bound. A bound is derived for exact comparison; comparing in
% floats adds rounding, which is far below it. The coefficients of det(z I - A) of the answer, of z^(n-1), ...,
% 1. Every entry differs from the true one by no more than its bound. A bound is derived for exact comparison;
% comparing in floats adds rounding, which is far below it. The eigenvalues of the answer's A, each as [re, im].
% Pair each true number with one of the answer's, so that none is used twice and the sum of distances is least;
% each is within its bound.
%
% Made by faultspace 0.1.0: faultspace audit --reproduce 'form-fortran-order[whole-numbers]-identify' --language
% octave

failed = false;
% -- how ggleizer/fault_id: rank with the example's threshold 1 is called
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

function a = asked_identify(q), [a.A, a.B, a.C, a.D] = pi_moesp(q.u, q.y, q.block_rows, q.order); end

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
function [A_, B_, C_, D_] = identify(y, u, order, block_rows)
  a = asked_identify(struct("y", y, "u", u, "order", order, "block_rows", block_rows)); A_ = a.A; B_ = a.B; C_ = a.C; D_ = a.D;
end

% -- the question
y = [
  -30.0 -2.0 17.0
  28.0 -4.0 -40.0
  -74.0 -50.0 101.0
  53.0 89.0 -103.0
  4.0 -8.0 -8.0
  -41.0 -61.0 67.0
  -6.0 14.0 1.0
  48.0 36.0 -67.0
  -26.0 -58.0 58.0
  -30.0 6.0 34.0
  71.0 75.0 -112.0
  -63.0 -35.0 79.0
  30.0 34.0 -59.0
  -12.0 -48.0 31.0
  -38.0 -30.0 58.0
  40.0 68.0 -72.0
  11.0 7.0 -18.0
  -53.0 -21.0 60.0
  52.0 36.0 -81.0
  -73.0 -41.0 94.0
  62.0 58.0 -101.0
  -66.0 -30.0 80.0
  41.0 57.0 -82.0
  -16.0 -44.0 30.0
  -23.0 -55.0 51.0
  23.0 -9.0 -9.0
  5.0 -3.0 12.0
  34.0 14.0 -31.0
  0.0 -36.0 28.0
  -3.0 -23.0 27.0
  36.0 4.0 -26.0
  -4.0 -28.0 33.0
  19.0 3.0 -8.0
  20.0 -8.0 -5.0
  -18.0 -10.0 35.0
  49.0 29.0 -60.0
  -53.0 -21.0 71.0
  77.0 41.0 -104.0
  -67.0 -95.0 122.0
  39.0 11.0 -37.0
  -18.0 14.0 26.0
  44.0 76.0 -83.0
  -1.0 -29.0 7.0
  -52.0 -68.0 85.0
  9.0 45.0 -28.0
  67.0 31.0 -86.0
  -97.0 -73.0 140.0
  76.0 80.0 -122.0
  -21.0 -49.0 46.0
  -23.0 -31.0 42.0
  42.0 14.0 -44.0
  -19.0 -31.0 46.0
  23.0 19.0 -25.0
  2.0 6.0 1.0
  2.0 10.0 -6.0
  -14.0 18.0 3.0
  31.0 15.0 -48.0
  -40.0 -68.0 73.0
  14.0 -14.0 -2.0
  -7.0 13.0 13.0
];
u = [
  7.0
  -8.0
  6.0
  9.0
  -3.0
  -5.0
  5.0
  -3.0
  -8.0
  9.0
  1.0
  7.0
  1.0
  -9.0
  2.0
  7.0
  -1.0
  8.0
  -4.0
  8.0
  -1.0
  9.0
  4.0
  -7.0
  -8.0
  -8.0
  -2.0
  -5.0
  -9.0
  -5.0
  -8.0
  -6.0
  -4.0
  -7.0
  2.0
  -5.0
  8.0
  -9.0
  -7.0
  -7.0
  8.0
  8.0
  -7.0
  -4.0
  9.0
  -9.0
  6.0
  1.0
  -7.0
  -2.0
  -7.0
  -3.0
  -1.0
  1.0
  2.0
  8.0
  -4.0
  -7.0
  -7.0
  5.0
];
order = 3;
block_rows = 4;

try
  [A_, B_, C_, D_] = identify(y, u, order, block_rows);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', 'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nWRONG: an answer is due\n', problem.message); exit(1);
end

expected = [
  -2.0
  2.0
  1.0
  4.0
  4.0
  -7.0
  -5.0
  -5.0
  7.0
  1.0
  1.0
  -2.0
  0.0
  0.0
  0.0
  0.0
  0.0
  0.0
  0.0
  0.0
  0.0
  0.0
  0.0
  0.0
];
bound = [
  3e-08
  3e-08
  4.5e-08
  2.2e-08
  2.2e-08
  3.3e-08
  2.4e-08
  2.4e-08
  3.5e-08
  1.3e-08
  1.3e-08
  1.9e-08
  3.6e-09
  3.5e-09
  5.3e-09
  1.3e-09
  1.2e-09
  1.9e-09
  1.8e-10
  1.8e-10
  2.6e-10
  1.2e-24
  1.2e-24
  1.8e-24
];
what = 'Markov parameters';
got = D_; powered = B_;
while size(got, 1) < size(expected, 1), got = [got; C_ * powered]; powered = A_ * powered; end
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

z = 1;
expected = [
  -2.0
  2.0
  -1.0
];
bound = [
  6.1e-08
  6.1e-08
  9.1e-08
];
what = 'transfer function at 1';
got = D_ + C_ * ((z * eye(size(A_)) - A_) \ B_);
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

z = -1;
expected = [
  -12.0
  -8.0
  17.0
];
bound = [
  7.3e-08
  7.3e-08
  1.1e-07
];
what = 'transfer function at -1';
got = D_ + C_ * ((z * eye(size(A_)) - A_) \ B_);
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

z = 2;
expected = [
  -1.125
  2.875
  -1.0
];
bound = [
  4.3e-08
  4.2e-08
  6.3e-08
];
what = 'transfer function at 2';
got = D_ + C_ * ((z * eye(size(A_)) - A_) \ B_);
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

expected = [
  0.0
  0.0
  0.0
];
bound = [
  7.3e-10
  3.3e-10
  9e-11
];
what = 'characteristic polynomial';
got = poly(A_); got = got(2:end)';
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

expected = [
  complex(0.0,0.0)
  complex(0.0,0.0)
  complex(0.0,0.0)
];
bound = [
  0.00049
  0.00049
  0.00049
];
what = 'eigenvalues';
got = eig(A_);
left = got(:); got = expected; off = inf;
if numel(left) == numel(expected)
  for k = 1:numel(expected), [~, at] = min(abs(left - expected(k))); got(k) = left(at); left(at) = []; end
  off = abs(got - expected);
else, got = left; bound = 0; end
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

exit(double(failed));
