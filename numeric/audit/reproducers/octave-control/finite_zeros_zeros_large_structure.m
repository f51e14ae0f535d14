% finite-zeros[zeros-large]-structure: faults that no output shows are missed, or seen where there are none.
%
% How it is compared: As many as there are true ones. Pair each true number with one of the answer's, so that
% none is used twice and the sum of distances is least; each is within its bound.
%
% Made by faultspace 0.1.0: faultspace audit --reproduce 'finite-zeros[zeros-large]-structure' --language octave

failed = false;
% -- how Octave's control (SLICOT): moesp; zero is called
1;
pkg load control

function a = identify(q)
  % iddata: a row a sample. s and n are what a user gives; all else by default (Cholesky).
  found = moesp(iddata(q.y, q.u, 1), q.order, "s", q.block_rows);
  % Notices that take nothing from A, B, C, D: a Kalman gain of zero, QR where Cholesky failed.
  if ! isempty(regexp(lastwarn(), "gain matrix is set to zero|QR algorithm was then used")), lastwarn(""); end
  [a.A, a.B, a.C, a.D] = ssdata(found);
end

function a = asked_structure(q)
  [z, ~, info] = zero(ss(q.A, q.F, q.C, q.G, 1));
  infinite = [];  % infz(i) of order i; those of order 0 are not listed
  for i = 1:numel(info.infz), infinite = [infinite repmat(i, 1, info.infz(i))]; end
  a.normal_rank = info.rank;
  a.finite_zeros = num2cell([real(z(:)) imag(z(:))], 2)';
  a.infinite_zero_orders = [zeros(1, info.rank - numel(infinite)) infinite];
  % G has a row an output; F has none where there are no states, and then no columns in JSON.
  a.left_invertible = info.rank == columns(q.G);
end

function answer = structure(A, F, C, G)
  answer = asked_structure(struct("A", A, "F", F, "C", C, "G", G)); answer.finite_zeros = cellfun(@(z) complex(z(1), z(2)), answer.finite_zeros);
end

% -- the question
A = [
  0.0 -1.0 0.0 1.0
  -128.0 -514.0 0.0 513.5
  -128.25 -511.25 0.5 511.5
  -127.75 -514.0 0.0 513.5
];
F = [
  0.0
  -2.0
  -2.0
  -1.0
];
C = [
  29.125 129.625 -1.5 -128.125
  -62.25 -256.75 1.5 256.25
  98.875 383.375 1.5 -384.375
];
G = [
  0.5
  -1.0
  1.5
];

try
  answer = structure(A, F, C, G);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', 'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nWRONG: an answer is due\n', problem.message); exit(1);
end

expected = [
  complex(0.25,0.0)
  complex(256.0,0.0)
];
bound = [
  7.6e-11
  2e-08
];
what = 'number of finite zeros';
got = answer.finite_zeros;
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
