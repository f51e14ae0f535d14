% fault-dimension-shortest-record[one-fault]-fault_dimension: no number of faults, or a wrong one, from a record that has just samples enough.
%
% How it is compared: The number is equal to the true one.
%
% Made by faultspace 0.1.0: faultspace audit --reproduce 'fault-dimension-shortest-record[one-
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
  8.326185784185405 4.84339833083897 -0.932100791139676
  5.107449277704498 3.17688980079845 -2.165690842587205
  3.244380778791174 1.4494234666596892 -4.086057861601471
  -4.093619534942526 4.868945796922836 -5.458122003083912
  5.950078425154257 3.462719581288264 1.7385293155096522
  -0.14592319574330365 -6.197079667052594 1.4516310281425762
  -11.64487262469383 -3.8106901919576113 -5.545995926101944
  1.0667117586209993 5.969545979897519 -3.7444419225561467
  12.492136872523204 2.694848096309555 -0.5808806492382934
  -11.366337243249841 3.2987299903020126 -4.283010054753094
  9.907972072600876 -0.23871807601542613 6.042389885242086
  -6.870803549905202 -9.516865550058867 0.04142974745141818
  -13.881267261334315 1.0403405476215537 -5.0527338213167
  12.616550981521865 5.662638911792617 4.17019956302683
  2.716838243320523 -3.8736835815057824 2.9477438211088507
  -5.844780369040158 -4.319897445632113 -3.545235037109228
  -1.586957792862719 5.174966152108494 -6.1457914699214795
  12.59689431994905 6.731843399973057 -2.5336861519185185
  -1.2058662427392064 3.639615262174367 -3.97982977242243
  2.6482263641512813 0.30080406334183446 -0.5050902514578163
  -1.9405366360522076 -4.168225929925018 -3.7150594205089367
  -8.771692118493316 3.1796648087922477 -8.470653248202831
  11.44549748659812 6.377409972859699 -2.887288778851663
  0.16068963237756642 1.8811563548776082 -5.061226000213275
];

try
  answer = fault_dimension(r);
catch problem
  crashes = {'Octave:index-out-of-bounds', 'Octave:bad-index', 'Octave:undefined-function', 'MATLAB:badsubscript', 'MATLAB:UndefinedFunction'};
  if any(strcmp(problem.identifier, crashes)), fprintf('WRONG: a crash: %s\n', problem.message); exit(1); end
  fprintf('refused: %s\nWRONG: an answer is due\n', problem.message); exit(1);
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
