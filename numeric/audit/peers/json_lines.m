1;  % What the Octave peers share: questions in, answers out, every number to the last bit.
% jsondecode is off by up to two units in the last place and jsonencode writes 15 digits, either of which would be held against the peer.

function value = matrix_of(text)  % "[[1,2],[3,4]]", "[1,2]" or "1"
  text = strrep(strrep(strrep(regexprep(text, '\s', ''), '"', ''), 'Infinity', 'Inf'), 'null', 'NaN');
  width = 1 + sum(strtok(text, "]") == ",");  % of the first row
  value = sscanf(strrep(strrep(strrep(text, "[", " "), "]", " "), ",", " "), "%f");
  if strncmp(text, "[[", 2), value = reshape(value, width, [])'; end
end

function q = question(line)
  q.call = regexp(line, '"call":\s*"(\w+)"', "tokens", "once"){1};
  [names, from, to] = regexp(line, '"(\w+)":', "tokens", "start", "end"); from(end+1) = rindex(line, "}");
  for k = find(! strcmp([names{:}], "call"))
    q.(names{k}{1}) = matrix_of(regexprep(line(to(k)+1:from(k+1)-1), ',\s*$', ''));
  end
end

function text = written(value)
  if islogical(value), text = {"false", "true"}{value + 1}; return; end
  if iscell(value), text = ["[" strjoin(cellfun(@written, value, "uniformoutput", false), ",") "]"]; return; end
  numbers = strsplit(strtrim(sprintf("%.17g ", value.')), " ");
  for k = find(! isfinite(value.'(:)))', numbers{k} = ['"' strrep(numbers{k}, "Inf", "Infinity") '"']; end
  if isempty(value), text = "[]"; return; end
  if isscalar(value), text = numbers{1}; return; end
  numbers = reshape(numbers, columns(value), [])';
  lines = cellfun(@(k) ["[" strjoin(numbers(k, :), ",") "]"], num2cell(1:rows(value)), "uniformoutput", false);
  text = ["[" strjoin(lines, ",") "]"];
  if isrow(value), text = lines{1}; end
end

% What a package raises or warns of by its own words is a refusal; a wrong index, an unknown name, a wrong call of a library is a crash.
function answer = answered(functions, q)
  try
    lastwarn("");
    a = functions.(q.call)(q); names = fieldnames(a)';
    if ! isempty(lastwarn()), error(lastwarn()); end
    answer = ["{" strjoin(cellfun(@(name) ['"' name '": ' written(a.(name))], names, "uniformoutput", false), ", ") "}"];
  catch e
    crashes = {"Octave:index-out-of-bounds", "Octave:bad-index", "Octave:undefined-function"};
    if any(strcmp(e.identifier, crashes)) || ! isempty(strfind(e.message, "XERBLA"))
      fprintf(stderr, "%s (in %s)\n", e.message, e.stack(1).name); exit(1);
    end
    answer = ['{"refused": ' jsonencode(e.message) '}'];
  end
end

function answer_questions(functions)
  warning("off", "backtrace");
  while true
    try line = input("", "s"); catch, exit(0); end
    q = question(line);
    if strcmp(q.call, "functions")
      answer = ['{"functions": ' jsonencode(fieldnames(functions)') '}'];
    else
      answer = answered(functions, q);
    end
    puts([answer "\n"]); fflush(stdout);
  end
end
