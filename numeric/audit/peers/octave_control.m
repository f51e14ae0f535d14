1;  % octave-cli --quiet octave_control.m: moesp and zero of Octave's package control (SLICOT), behind JSON lines. See PROTOCOL.md.
pkg load control
source(fullfile(fileparts(mfilename("fullpath")), "json_lines.m"));

function a = identify(q)
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

answer_questions(struct("identify", @identify, "structure", @structure));
