% far-units[n3-u2-p2]-identify: an output in large units is lost.
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
% Made by faultspace 0.1.0: faultspace audit --reproduce 'far-units[n3-u2-p2]-identify' --language octave

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
  7.457142857142857 -2.648571428571429e-07
  1.2107142857142856 1.9536904761904762e-07
  -10.425347222222221 1.1234126984126984e-08
  4.762383742559524 -7.414933655753968e-08
  2.3799602690197172 6.292115711030506e-08
  1.4466789745149158 -2.492526432824513e-09
  -12.15347046781154 1.842640489576355e-07
  -1.4288878914486203 -1.068829941412227e-07
  4.178940824338647 -1.0759505653488985e-07
  0.4762643054833707 4.685286731328294e-08
  1.6490463628086882 -1.2034126784380949e-08
  -2.326549194044256 -2.855292755551543e-09
  -0.8081964268139168 7.635125368025483e-08
  -2.380479550490385 -6.186627186146621e-08
  6.73205257632077 -1.0885025342921205e-07
  -0.9772665048362301 3.081938480694609e-09
  9.143896069291603 -1.6587683651002573e-07
  1.4386030969500707 -5.6749002075016646e-09
  7.818672513179403 -1.1007547868445253e-07
  -0.6237743789901787 4.188752053155066e-08
  -8.708765388021172 7.576201562063908e-08
  -0.8836483108008946 -5.495586472860778e-08
  6.010935931796171 -1.690571658409052e-07
  3.8813850158633034 6.99516378007241e-08
  -5.146259633144598 8.007873846687413e-08
  -6.089275219816571 2.490816411981989e-08
  4.220430778578332 2.0034671602824688e-08
  -8.34383476429625 1.1057495769456577e-07
  5.2928754924994275 -1.856821589345389e-07
  7.780632231586712 2.2988817023950968e-08
  -6.978886278953094 8.389561705911971e-08
  1.3952170023125676 -1.339565567910437e-07
  0.5714529252505142 5.785527342964997e-08
  0.6885542252951238 -1.0826098132475867e-07
  7.556461006150733 1.287464070294791e-08
  -5.510092569017176 1.397204569039281e-07
  -7.601145420391917 5.6336941908904735e-08
  1.4501351840540164 5.607647285494506e-08
  -6.985549416237076 4.466765066842645e-08
  6.894243647959393 -1.2578204289502475e-07
  -1.793124971398495 -1.1270140129673425e-08
  1.7572330540655134 4.282797641643955e-08
  4.271613615653806 -8.134307397150027e-08
  -1.7542700534460933 -3.7928597248316274e-08
  10.468051357798535 -8.050291536452084e-08
  -4.7590939065907065 -6.282351901766596e-09
  5.57887735523188 2.5686990575909093e-08
  -6.796451309311178 1.0847798325104577e-07
  1.1190867049075022 -1.0661572659534808e-07
  3.5087189292020766 -2.5042716569540467e-08
  5.951543055996003 -1.4335872979606574e-08
  -6.855106861884992 3.854086136189183e-08
  -0.4279460380943698 1.4710982526165969e-08
  0.19374248840180666 -1.0153234261527922e-07
  2.5397254778303977 1.5376628618745972e-10
  4.101398420381141 -9.555894880362473e-09
  0.18580068750372775 1.7639679531184504e-08
  -3.268093894640271 1.2859245516890591e-07
  -1.9504699309281557 -3.250439462557786e-08
  0.1062716437862573 8.9916785238114e-08
  -5.591765956432365 1.5532908459371966e-07
  -7.862691370665111 2.2960474530099993e-08
  6.352809477848461 -1.0669182376947708e-07
  -3.934632419621431 1.4768316132811758e-07
  -5.711162356237449 2.265092139608183e-08
  -3.2655490274785066 3.784294983273662e-08
  6.370673567283719 -1.991489733908073e-07
  7.996896184316661 -5.429734763202348e-08
  5.659869226338252 -1.2240512242449255e-08
  -0.6333636386961231 2.1265284606826685e-08
  -2.5058472097879574 1.1450255417782933e-07
  -7.759979198122986 1.0482402566676952e-07
  -0.4638160237565909 -1.320537595377446e-08
  1.2774592379341907 9.335385676910099e-08
  -4.938587420895998 -2.0625642602782663e-08
  0.2273075730113712 -2.7227733379073436e-09
  5.372199664668861 -4.942430913754496e-08
  -4.890817824843731 1.2524344704924842e-08
  -1.668981145086166 -2.511191550568764e-08
  2.755048285334623 5.11954434770899e-08
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
  -1.0 1.0
  1.0 -1.3333333333333333
  -1.0 2.6666666666666665
  0.6666666666666666 -0.3333333333333333
  -1.6666666666666667 -2.6666666666666665
  -0.3333333333333333 0.6666666666666666
  -2.0 -3.0
  0.6666666666666666 -1.3333333333333333
  -1.0 -2.3333333333333335
  1.6666666666666667 -1.6666666666666667
  0.3333333333333333 2.3333333333333335
  -2.6666666666666665 2.3333333333333335
  -2.6666666666666665 -3.0
  -2.3333333333333335 1.3333333333333333
  1.0 2.0
  0.6666666666666666 1.0
  -2.0 1.0
  2.3333333333333335 2.6666666666666665
  -1.0 -3.0
  -0.6666666666666666 -1.6666666666666667
  2.6666666666666665 1.6666666666666667
  -0.3333333333333333 -3.0
  -1.6666666666666667 2.0
  -1.0 -1.0
  -1.6666666666666667 -0.6666666666666666
  2.6666666666666665 1.6666666666666667
  2.0 1.0
  -0.6666666666666666 1.6666666666666667
  2.3333333333333335 1.0
  -1.3333333333333333 -2.0
  0.6666666666666666 -2.0
  -2.3333333333333335 3.0
  0.6666666666666666 -2.0
  1.6666666666666667 -2.3333333333333335
  -2.3333333333333335 -1.0
  2.6666666666666665 -2.3333333333333335
  -2.3333333333333335 1.0
  2.6666666666666665 2.0
  0.3333333333333333 -2.0
  -0.6666666666666666 -1.0
  -0.3333333333333333 -0.6666666666666666
  3.0 -1.3333333333333333
  -1.6666666666666667 2.3333333333333335
  -0.6666666666666666 -1.6666666666666667
  -2.3333333333333335 0.6666666666666666
  -1.0 0.6666666666666666
  2.0 -2.0
  1.6666666666666667 2.3333333333333335
  2.0 -1.3333333333333333
  0.6666666666666666 0.3333333333333333
  2.0 3.0
  2.6666666666666665 1.0
  -1.3333333333333333 -2.6666666666666665
  0.6666666666666666 2.3333333333333335
  0.3333333333333333 1.3333333333333333
  -0.6666666666666666 2.6666666666666665
  -1.6666666666666667 -3.0
  -1.3333333333333333 -2.3333333333333335
  0.3333333333333333 -1.0
  3.0 -2.3333333333333335
  1.6666666666666667 1.0
  2.3333333333333335 2.3333333333333335
  0.3333333333333333 -0.3333333333333333
  0.6666666666666666 1.6666666666666667
  3.0 -1.6666666666666667
  -0.6666666666666666 0.3333333333333333
  -1.0 -0.6666666666666666
  1.6666666666666667 -1.0
  -2.3333333333333335 1.0
  -2.6666666666666665 2.6666666666666665
  1.3333333333333333 0.6666666666666666
];
order = 3;
block_rows = 5;

try
  [A_, B_, C_, D_] = identify(y, u, order, block_rows);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', 'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nWRONG: an answer is due\n', problem.message); exit(1);
end

expected = [
  1.2857142857142858 -0.42857142857142855
  8.571428571428572e-09 8.571428571428572e-09
  -1.9333333333333333 -1.4666666666666666
  2.2e-08 3.3333333333333334e-08
  -0.09166666666666666 -0.225
  -5.416666666666666e-09 -1.1416666666666666e-08
  0.08229166666666667 0.13229166666666667
  1.3958333333333334e-09 4.947916666666667e-09
  -0.024446614583333335 -0.04967447916666667
  -4.98046875e-10 -2.6575520833333335e-09
  0.0065948486328125 0.021254475911458334
  2.496541341145833e-10 1.5679931640625e-09
  -0.0022413571675618488 -0.011109352111816406
  -1.456292470296224e-10 -9.50524648030599e-10
  0.0010598053534825642 0.006467928489049275
  8.831546703974406e-11 5.796112616856893e-10
];
bound = [
  6.6e-08 6e-08
  1.1000000000000001e-15 9.999999999999999e-16
  4.2e-08 3.8e-08
  7e-16 6.4e-16
  3.3e-08 3e-08
  5.500000000000001e-16 4.999999999999999e-16
  2.5e-08 2.3e-08
  4.2e-16 3.9e-16
  1.7e-08 1.6e-08
  2.9000000000000003e-16 2.6000000000000003e-16
  1.1e-08 1e-08
  1.9e-16 1.7e-16
  7e-09 6.4e-09
  1.2e-16 1.1e-16
  4.4e-09 4.1e-09
  7.400000000000001e-17 6.8e-17
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
  -0.6764044943820224 -2.0234349919743178
  2.6211419399220363e-08 3.375586639150042e-08
];
bound = [
  1.1e-07 1e-07
  1.9e-15 1.6999999999999998e-15
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
  3.0092134280813525 0.5822919219145635
  -2.136110430450053e-08 -4.778992077105285e-08
];
bound = [
  1.7e-07 1.6e-07
  2.8999999999999998e-15 2.6e-15
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
  0.3050670339017376 -1.2041935004792959
  1.8366668016795603e-08 2.2873938461123036e-08
];
bound = [
  8.8e-08 8e-08
  1.5e-15 1.3e-15
];
what = 'transfer function at 2';
got = D_ + C_ * ((z * eye(size(A_)) - A_) \ B_);
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

expected = [
  0.90625
  0.20703125
  0.01611328125
];
bound = [
  2.9e-09
  2.1e-09
  3.7e-10
];
what = 'characteristic polynomial';
got = poly(A_); got = got(2:end)';
off = abs(got - expected);
ratio = max([0; off(:) ./ max(bound(:), realmin)]); wrong = any(~(off(:) <= bound(:))); failed = failed || wrong;
words = {'right', 'WRONG'}; fprintf('%s: %s\n', what, words{wrong + 1});
disp('  got'); disp(got); disp('  expected'); disp(expected);
fprintf('  off by %.3g, largest ratio to the bound %.3g\n', max([0; off(:)]), ratio);

expected = [
  complex(-0.1479900098498031,-0.06710056775666158)
  complex(-0.1479900098498031,0.06710056775666158)
  complex(-0.6102699803003938,0.0)
];
bound = [
  3.7e-09
  3.7e-09
  2e-09
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
