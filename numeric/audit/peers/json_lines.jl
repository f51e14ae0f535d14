# What adapters in Julia share: questions in, answers out, every number to the last bit, with the standard library alone.
#     answer_questions((structure = structure,), line)   answers what is asked of these functions, which take their arguments by position;
#         line   a question that is answered to nobody before any other: Julia compiles then, for longer than an answer may take
using LinearAlgebra

const NAMES = Dict("structure" => ("A", "F", "C", "G"))  # of the arguments, by position

# The text becomes nested vectors, dictionaries, numbers and strings; `tokens` is what is left of it.
read_text(text) = read_value(collect(String, (m.match for m in eachmatch(r"[\[\]{}]|\"(?:[^\"\\]|\\.)*\"|[^\s,:\[\]{}\"]+", text))))
function read_value(tokens)
    token = popfirst!(tokens)
    if token == "["
        found = Any[]
        while tokens[1] != "]"; push!(found, read_value(tokens)); end
        popfirst!(tokens)
        return found
    elseif token == "{"
        entries = Dict{String,Any}()
        while tokens[1] != "}"; name = read_value(tokens); entries[name] = read_value(tokens); end
        popfirst!(tokens)
        return entries
    end
    words = Dict("\"NaN\"" => NaN, "\"Infinity\"" => Inf, "\"-Infinity\"" => -Inf, "null" => NaN, "true" => true, "false" => false)
    haskey(words, token) && return words[token]
    return startswith(token, '"') ? String(token[2:end-1]) : parse(Float64, token)
end

# Rows of numbers become a matrix. JSON has no columns where there is no row: they are `columns`.
matrix(rows, columns) = isempty(rows) ? zeros(0, columns) : permutedims(reduce(hcat, [Vector{Float64}(row) for row in rows]))
width(rows) = isempty(rows) ? 0 : length(rows[1])
function arguments(question)
    columns = Dict("A" => width(question["A"]), "C" => width(question["A"]), "F" => width(question["G"]), "G" => width(question["F"]))
    return [matrix(question[name], columns[name]) for name in NAMES[question["call"]]]
end

written(value::Bool) = string(value)
written(value::Integer) = string(value)
written(value::AbstractFloat) = isfinite(value) ? string(Float64(value)) : isnan(value) ? "\"NaN\"" : value > 0 ? "\"Infinity\"" : "\"-Infinity\""
written(value::Complex) = written([real(value), imag(value)])
written(value::AbstractVector) = "[" * join(map(written, value), ",") * "]"
written(value::AbstractString) = "\"" * replace(replace(value, r"[\"\\]" => c -> "\\" * c), r"[[:cntrl:]]" => " ") * "\""
written(value::NamedTuple) = "{" * join(["\"$name\": " * written(one) for (name, one) in pairs(value)], ", ") * "}"

# What a package raises by its own words is a refusal; a wrong index, an unknown name, a wrong call is a crash.
const CRASHES = Union{BoundsError,MethodError,UndefVarError,UndefRefError,TypeError,InexactError,StackOverflowError}
function answered(functions, question)
    try
        return written(functions[Symbol(question["call"])](arguments(question)...))
    catch problem
        problem isa CRASHES && (println(stderr, sprint(showerror, problem)); exit(1))
        return written((refused = sprint(showerror, problem),))
    end
end

function answer_questions(functions, line)
    answered(functions, read_text(line))
    for line in eachline(stdin)
        question = read_text(line)
        offered = (functions = [string(name) for name in keys(functions)],)
        println(question["call"] == "functions" ? written(offered) : answered(functions, question))
        flush(stdout)
    end
end
