% refuses-unexciting-input[n2-u1-p1-constant]-identify: one of many models that fit, without a word.
%
% How it is compared: No answer is right. The function raises an error or answers nothing. It must be refused.
%
% Made by faultspace 0.1.0: faultspace audit --reproduce 'refuses-unexciting-input[n2-u1-p1-constant]-identify'
% --language octave

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
  -18.47142857142857
  53.82857142857143
  54.05357142857143
  38.43482142857143
  24.71919642857143
  16.134626116071427
  11.623420061383928
  9.553989519391742
  8.730064119611468
  8.46181732586452
  8.407335062537875
  8.418342068259205
  8.439891193368073
  8.456338895336792
  8.466016763441855
  8.470886963228129
  8.473031354393136
  8.473842340459269
  8.47408286769979
  8.47411592583328
  8.47409223636622
  8.47406427661584
  8.474044993905178
  8.474034237728745
  8.474029044167322
  8.474026852714672
  8.474026071285165
  8.474025866914614
  8.474025859028085
  8.474025896833432
  8.474025931638288
  8.474025953822617
  8.474025965620344
  8.474025971090532
  8.474025973296193
  8.474025974029544
  8.474025974188738
  8.474025974167612
  8.474025974114301
  8.474025974072278
  8.474025974047168
  8.47402597403439
  8.474025974028702
  8.47402597402652
  8.474025974025855
  8.47402597402575
  8.474025974025805
  8.474025974025874
  8.474025974025924
  8.474025974025952
  8.474025974025965
  8.474025974025972
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
  8.474025974025974
];
u = [
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
  1.5
];
order = 2;
block_rows = 4;

try
  [A_, B_, C_, D_] = identify(y, u, order, block_rows);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', 'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nright: there is nothing to answer\n', problem.message); exit(0);
end

disp('WRONG: answered where no answer can be right'); failed = true;

exit(double(failed));
