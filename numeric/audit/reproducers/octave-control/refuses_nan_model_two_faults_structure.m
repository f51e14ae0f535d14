% refuses-nan-model[two-faults]-structure: answers about no system.
% It must be refused.
% Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-nan-model[two-faults]-structure' --language octave

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
  NaN NaN NaN
  NaN NaN NaN
  NaN NaN NaN
];
F = [
  -2.6666666666666665 -1.6666666666666667
  2.6666666666666665 -1.6666666666666667
  2.0 0.3333333333333333
];
C = [
  0.2 -1.6 -1.6
  1.4 -0.4 0.4
  0.2 0.8 -1.4
];
G = [
  -1.0 1.2857142857142858
  -1.2857142857142858 -0.8571428571428571
  0.42857142857142855 0.7142857142857143
];
try
  answer = structure(A, F, C, G);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', ...
             'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nright: there is nothing to answer\n', problem.message); exit(0);
end
disp('WRONG: answered where a refusal is due'); failed = true;
exit(double(failed));
