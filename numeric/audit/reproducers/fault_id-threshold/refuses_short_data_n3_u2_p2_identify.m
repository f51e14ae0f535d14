% refuses-short-data[n3-u2-p2]-identify: a model from fewer equations than unknowns.
%
% How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.
%
% Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-short-data[n3-u2-p2]-identify' --language
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
  7.457142857142857 -26.485714285714284
  1.2107142857142856 19.53690476190476
  -10.425347222222221 1.1234126984126984
  4.762383742559524 -7.414933655753968
  2.3799602690197172 6.292115711030506
  1.4466789745149158 -0.24925264328245134
  -12.15347046781154 18.42640489576355
  -1.4288878914486203 -10.68829941412227
  4.178940824338647 -10.759505653488986
];
u = [
  1.0 1.0
  2.3333333333333335 1.6666666666666667
  -2.0 -1.3333333333333333
  -0.3333333333333333 1.6666666666666667
  2.0 -2.3333333333333335
  3.0 3.0
  -1.6666666666666667 1.0
  -2.3333333333333335 -2.3333333333333335
  -2.6666666666666665 2.3333333333333335
];
order = 3;
block_rows = 5;

try
  [A_, B_, C_, D_] = identify(y, u, order, block_rows);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', 'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nright: there is nothing to answer\n', problem.message); exit(0);
end

disp('WRONG: answered where no answer can be right'); failed = true;

exit(double(failed));
