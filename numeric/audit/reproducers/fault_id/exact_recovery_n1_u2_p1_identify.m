% exact-recovery[n1-u2-p1]-identify: the model is wrong although the data determine it: every prediction and every residual made with it.
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
% Made by faultspace 0.1.0: faultspace audit --reproduce 'exact-recovery[n1-u2-p1]-identify' --language octave

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
  -27.542857142857144
  9.414285714285715
  1.3803571428571428
  -2.1354910714285715
  2.780571056547619
  -2.0605712890625
  3.4619999476841516
  7.3719881148565385
  7.904552075976417
  -0.5903975046816327
  -4.975029507172959
  12.120397969951764
  1.8584221898395168
  6.182853583572086
  -2.0614272366966753
  -5.005536214810175
  -3.9753048718271367
  -2.103308292112443
  6.668502514304071
  -0.32330749048307417
  1.4986212613121053
  -1.3548401158491823
  5.700922186300586
  12.10263037061347
  2.7257993253056627
  -14.660269985084861
  6.086886958692538
  -0.979011180938273
  0.02308157380423331
  10.01753488601389
  -5.511337487017113
  13.22865631953618
  -0.846460405540353
  -6.104005919350939
  2.1592403149946975
  4.209332500924607
  5.7607860264389865
  0.3897052400853801
  -0.8782823221748747
  1.9924511089108161
  -9.606692975365366
  7.878700341952488
  -1.054512628232183
  -2.0438434786986455
  1.777155590226278
  -2.0878619177634254
  -7.611099399886334
  6.599400370195471
  5.020462956414794
  6.3649454389635
  -7.753521206277979
  8.532570452354243
  4.833619413700492
  -0.39117870870911325
  6.740739634813536
  -1.9789678392455523
  -0.2674108698067274
  -12.772339971441525
  0.3539132035762861
  -4.189860308483964
  -12.832373812889942
  5.5585687512623
  3.978631956371876
  -1.9574631741156439
  -2.098094166849491
  1.4260710268542733
  5.587842412548695
  -0.5621075713724274
  -6.077304898830578
  -4.009105901033771
  13.505795665268616
  4.628183768381412
  1.7203834678093517
  -8.140381895666602
  -12.55807107483931
  2.2104671292552176
  1.2496462551007221
  -0.7412363932818183
  -1.0720363525193182
  -6.583700653519541
];
u = [
  -0.3333333333333333 -1.3333333333333333
  -0.6666666666666666 1.6666666666666667
  -2.0 -2.3333333333333335
  -1.3333333333333333 -0.3333333333333333
  3.0 1.6666666666666667
  2.3333333333333335 2.3333333333333335
  -3.0 -0.3333333333333333
  -1.6666666666666667 2.0
  -1.3333333333333333 0.6666666666666666
  1.3333333333333333 -1.6666666666666667
  -3.0 0.6666666666666666
  1.0 2.3333333333333335
  0.3333333333333333 2.3333333333333335
  2.6666666666666665 2.6666666666666665
  1.0 -0.6666666666666666
  -1.6666666666666667 -2.6666666666666665
  -0.3333333333333333 -2.3333333333333335
  0.3333333333333333 2.3333333333333335
  -2.0 -1.0
  -0.3333333333333333 0.3333333333333333
  1.6666666666666667 0.6666666666666666
  1.6666666666666667 2.0
  -2.3333333333333335 2.0
  -2.6666666666666665 2.0
  2.6666666666666665 -2.6666666666666665
  -2.3333333333333335 -1.6666666666666667
  -3.0 -1.6666666666666667
  3.0 1.0
  -2.6666666666666665 2.0
  1.3333333333333333 -0.6666666666666666
  -0.6666666666666666 2.6666666666666665
  0.6666666666666666 2.6666666666666665
  2.0 -0.6666666666666666
  2.0 1.0
  2.0 2.6666666666666665
  -0.6666666666666666 1.6666666666666667
  1.3333333333333333 2.0
  3.0 1.6666666666666667
  -1.6666666666666667 0.3333333333333333
  1.6666666666666667 -2.0
  -3.0 -1.3333333333333333
  2.3333333333333335 2.6666666666666665
  2.3333333333333335 1.0
  -1.6666666666666667 -1.0
  -1.3333333333333333 -0.6666666666666666
  2.6666666666666665 -1.0
  -1.6666666666666667 -0.6666666666666666
  1.3333333333333333 2.6666666666666665
  -3.0 1.3333333333333333
  1.3333333333333333 -1.3333333333333333
  0.6666666666666666 1.6666666666666667
  -2.0 1.3333333333333333
  1.3333333333333333 0.6666666666666666
  -0.3333333333333333 2.3333333333333335
  -3.0 -2.3333333333333335
  -3.0 -1.3333333333333333
  1.6666666666666667 -3.0
  2.6666666666666665 0.6666666666666666
  -1.6666666666666667 -1.3333333333333333
  3.0 -2.3333333333333335
  -3.0 -3.0
  1.0 3.0
  -1.6666666666666667 -1.0
  -1.6666666666666667 -2.3333333333333335
  0.6666666666666666 0.3333333333333333
  -2.6666666666666665 -0.3333333333333333
  0.3333333333333333 1.3333333333333333
  -1.0 -2.0
  1.6666666666666667 -2.0
  -1.6666666666666667 2.0
  -1.3333333333333333 2.0
  -2.6666666666666665 -0.3333333333333333
  -2.0 -2.6666666666666665
  2.6666666666666665 -3.0
  -1.6666666666666667 -2.3333333333333335
  -1.6666666666666667 -0.6666666666666666
  1.3333333333333333 1.0
  -1.0 -0.6666666666666666
  0.6666666666666666 -1.3333333333333333
  -0.3333333333333333 -2.0
];
order = 1;
block_rows = 3;

try
  [A_, B_, C_, D_] = identify(y, u, order, block_rows);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', 'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nWRONG: an answer is due\n', problem.message); exit(1);
end

expected = [
  -0.5714285714285714 1.0
  -2.0 2.4
  0.75 -0.9
  -0.28125 0.3375
];
bound = [
  5.8e-10 6.3e-10
  6.1e-10 6.6e-10
  2.5e-10 2.8e-10
  1e-10 1.1e-10
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
  -2.0259740259740258 2.7454545454545456
];
bound = [
  1e-09 1.1e-09
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
  2.6285714285714286 -2.84
];
bound = [
  1.6e-09 1.8e-09
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
  -1.413533834586466 2.0105263157894737
];
bound = [
  8.4e-10 9.1e-10
];
what = 'transfer function at 2';
got = D_ + C_ * ((z * eye(size(A_)) - A_) \ B_);
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

expected = [
  0.375
];
bound = [
  8e-12
];
what = 'characteristic polynomial';
got = poly(A_); got = got(2:end)';
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

expected = [
  complex(-0.375,0.0)
];
bound = [
  8e-12
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
