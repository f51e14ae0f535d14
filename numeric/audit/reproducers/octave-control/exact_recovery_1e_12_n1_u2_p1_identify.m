% exact-recovery-1e-12[n1-u2-p1]-identify: the answer depends on the size of the signals.
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
% Made by faultspace 0.1.0: faultspace audit --reproduce 'exact-recovery-1e-12[n1-u2-p1]-identify' --language
% octave

failed = false;
% -- how Octave's control (SLICOT): moesp; zero is called
1;
pkg load control

function a = asked_identify(q)
  % iddata: a row a sample. s and n are what a user gives; all else by default (Cholesky).
  found = moesp(iddata(q.y, q.u, 1), q.order, "s", q.block_rows);
  % Notices that take nothing from A, B, C, D: a Kalman gain of zero, QR where Cholesky failed.
  if ! isempty(regexp(lastwarn(), "gain matrix is set to zero|QR algorithm was then used")), lastwarn(""); end
  [a.A, a.B, a.C, a.D] = ssdata(found);
end

function a = structure(q)
  [z, ~, info] = zero(ss(q.A, q.F, q.C, q.G, 1));
  infinite = [];  % infz(i) of order i; those of order 0 are not listed
  for i = 1:numel(info.infz), infinite = [infinite repmat(i, 1, info.infz(i))]; end
  a.normal_rank = info.rank;
  a.finite_zeros = num2cell([real(z(:)) imag(z(:))], 2)';
  a.infinite_zero_orders = [zeros(1, info.rank - numel(infinite)) infinite];
  % G has a row an output; F has none where there are no states, and then no columns in JSON.
  a.left_invertible = info.rank == columns(q.G);
end

function [A_, B_, C_, D_] = identify(y, u, order, block_rows)
  a = asked_identify(struct("y", y, "u", u, "order", order, "block_rows", block_rows)); A_ = a.A; B_ = a.B; C_ = a.C; D_ = a.D;
end

% -- the question
y = [
  -2.7542857142857143e-11
  9.414285714285715e-12
  1.3803571428571429e-12
  -2.1354910714285714e-12
  2.780571056547619e-12
  -2.0605712890625e-12
  3.461999947684152e-12
  7.371988114856539e-12
  7.904552075976417e-12
  -5.903975046816326e-13
  -4.975029507172959e-12
  1.2120397969951764e-11
  1.858422189839517e-12
  6.182853583572086e-12
  -2.061427236696675e-12
  -5.005536214810175e-12
  -3.9753048718271365e-12
  -2.1033082921124428e-12
  6.668502514304071e-12
  -3.233074904830742e-13
  1.4986212613121053e-12
  -1.3548401158491824e-12
  5.7009221863005865e-12
  1.210263037061347e-11
  2.7257993253056626e-12
  -1.4660269985084863e-11
  6.086886958692538e-12
  -9.79011180938273e-13
  2.308157380423331e-14
  1.0017534886013888e-11
  -5.511337487017113e-12
  1.322865631953618e-11
  -8.46460405540353e-13
  -6.104005919350939e-12
  2.1592403149946973e-12
  4.209332500924608e-12
  5.760786026438987e-12
  3.8970524008538006e-13
  -8.782823221748747e-13
  1.992451108910816e-12
  -9.606692975365366e-12
  7.878700341952488e-12
  -1.054512628232183e-12
  -2.0438434786986455e-12
  1.7771555902262778e-12
  -2.0878619177634256e-12
  -7.611099399886335e-12
  6.599400370195471e-12
  5.020462956414794e-12
  6.3649454389635e-12
  -7.753521206277979e-12
  8.532570452354243e-12
  4.833619413700492e-12
  -3.9117870870911326e-13
  6.740739634813536e-12
  -1.978967839245552e-12
  -2.674108698067274e-13
  -1.2772339971441525e-11
  3.5391320357628613e-13
  -4.189860308483964e-12
  -1.2832373812889942e-11
  5.558568751262299e-12
  3.9786319563718756e-12
  -1.957463174115644e-12
  -2.0980941668494905e-12
  1.4260710268542734e-12
  5.587842412548695e-12
  -5.621075713724273e-13
  -6.077304898830578e-12
  -4.0091059010337715e-12
  1.3505795665268617e-11
  4.628183768381412e-12
  1.7203834678093516e-12
  -8.140381895666602e-12
  -1.255807107483931e-11
  2.2104671292552173e-12
  1.249646255100722e-12
  -7.412363932818184e-13
  -1.0720363525193182e-12
  -6.5837006535195415e-12
];
u = [
  -3.3333333333333334e-13 -1.3333333333333334e-12
  -6.666666666666667e-13 1.6666666666666666e-12
  -2e-12 -2.3333333333333334e-12
  -1.3333333333333334e-12 -3.3333333333333334e-13
  3e-12 1.6666666666666666e-12
  2.3333333333333334e-12 2.3333333333333334e-12
  -3e-12 -3.3333333333333334e-13
  -1.6666666666666666e-12 2e-12
  -1.3333333333333334e-12 6.666666666666667e-13
  1.3333333333333334e-12 -1.6666666666666666e-12
  -3e-12 6.666666666666667e-13
  1e-12 2.3333333333333334e-12
  3.3333333333333334e-13 2.3333333333333334e-12
  2.6666666666666667e-12 2.6666666666666667e-12
  1e-12 -6.666666666666667e-13
  -1.6666666666666666e-12 -2.6666666666666667e-12
  -3.3333333333333334e-13 -2.3333333333333334e-12
  3.3333333333333334e-13 2.3333333333333334e-12
  -2e-12 -1e-12
  -3.3333333333333334e-13 3.3333333333333334e-13
  1.6666666666666666e-12 6.666666666666667e-13
  1.6666666666666666e-12 2e-12
  -2.3333333333333334e-12 2e-12
  -2.6666666666666667e-12 2e-12
  2.6666666666666667e-12 -2.6666666666666667e-12
  -2.3333333333333334e-12 -1.6666666666666666e-12
  -3e-12 -1.6666666666666666e-12
  3e-12 1e-12
  -2.6666666666666667e-12 2e-12
  1.3333333333333334e-12 -6.666666666666667e-13
  -6.666666666666667e-13 2.6666666666666667e-12
  6.666666666666667e-13 2.6666666666666667e-12
  2e-12 -6.666666666666667e-13
  2e-12 1e-12
  2e-12 2.6666666666666667e-12
  -6.666666666666667e-13 1.6666666666666666e-12
  1.3333333333333334e-12 2e-12
  3e-12 1.6666666666666666e-12
  -1.6666666666666666e-12 3.3333333333333334e-13
  1.6666666666666666e-12 -2e-12
  -3e-12 -1.3333333333333334e-12
  2.3333333333333334e-12 2.6666666666666667e-12
  2.3333333333333334e-12 1e-12
  -1.6666666666666666e-12 -1e-12
  -1.3333333333333334e-12 -6.666666666666667e-13
  2.6666666666666667e-12 -1e-12
  -1.6666666666666666e-12 -6.666666666666667e-13
  1.3333333333333334e-12 2.6666666666666667e-12
  -3e-12 1.3333333333333334e-12
  1.3333333333333334e-12 -1.3333333333333334e-12
  6.666666666666667e-13 1.6666666666666666e-12
  -2e-12 1.3333333333333334e-12
  1.3333333333333334e-12 6.666666666666667e-13
  -3.3333333333333334e-13 2.3333333333333334e-12
  -3e-12 -2.3333333333333334e-12
  -3e-12 -1.3333333333333334e-12
  1.6666666666666666e-12 -3e-12
  2.6666666666666667e-12 6.666666666666667e-13
  -1.6666666666666666e-12 -1.3333333333333334e-12
  3e-12 -2.3333333333333334e-12
  -3e-12 -3e-12
  1e-12 3e-12
  -1.6666666666666666e-12 -1e-12
  -1.6666666666666666e-12 -2.3333333333333334e-12
  6.666666666666667e-13 3.3333333333333334e-13
  -2.6666666666666667e-12 -3.3333333333333334e-13
  3.3333333333333334e-13 1.3333333333333334e-12
  -1e-12 -2e-12
  1.6666666666666666e-12 -2e-12
  -1.6666666666666666e-12 2e-12
  -1.3333333333333334e-12 2e-12
  -2.6666666666666667e-12 -3.3333333333333334e-13
  -2e-12 -2.6666666666666667e-12
  2.6666666666666667e-12 -3e-12
  -1.6666666666666666e-12 -2.3333333333333334e-12
  -1.6666666666666666e-12 -6.666666666666667e-13
  1.3333333333333334e-12 1e-12
  -1e-12 -6.666666666666667e-13
  6.666666666666667e-13 -1.3333333333333334e-12
  -3.3333333333333334e-13 -2e-12
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
