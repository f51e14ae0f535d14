% fault-dimension-below-the-lag[one-fault]-fault_dimension: the gap of windows below the lag is taken for the number of faults.
%
% How it is compared: The number is equal to the true one. Nothing is due: whatever is answered is told, and
% counts neither for nor against. Nothing is due: the answer is told.
%
% Made by faultspace 0.1.0: faultspace audit --reproduce 'fault-dimension-below-the-lag[one-
% fault]-fault_dimension' --language octave

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

function a = window_ranks(q), a.ranks = arrayfun(@(s) rank_of(blkhankel(q.r, s)), 1:q.windows); end

function a = asked_fault_dimension(q)
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
function answer = fault_dimension(r)
  answer = asked_fault_dimension(struct("r", r)).n_v;
end

% -- the question
r = [
  4.857142857142857 3.6857142857142855 -1.7142857142857142
  4.071428571428571 10.273809523809524 0.3238095238095238
  15.0578125 0.22065972222222222 9.847222222222221
  -8.757254464285714 -12.112183779761905 2.4987103174603176
  -18.326808384486608 0.3106168232266865 -2.0306144593253967
  17.39695085797991 2.256704905676463 10.356056237599207
  -3.2079003061567035 -8.182406045520116 4.14231947641524
  -12.218569326400758 -0.1308358695771959 0.2908967759874132
  17.22475244179368 -0.8685726219581233 6.876819513903724
  -9.485496426107629 -1.574753853279565 -3.558210139425974
];

try
  answer = fault_dimension(r);
catch problem
  fprintf('refused: %s\nright: there is nothing to answer\n', problem.message); exit(0);
end

expected = [
  1
];
bound = 0.0;
what = 'n_v';
got = answer;
off = inf; if isequal(double(sort(got(:))), double(sort(expected(:)))), off = 0; end
bound = 0;
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

exit(double(failed));
