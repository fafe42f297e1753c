// Predict, then reveal: questions about single pixels, made from the run.

import {element} from "./legend.js";

// Fill a list with the questions; `show` marks a question's pixel, before or at its step.
export function fillQuestions(items, questions, show) {
  questions.forEach((question, number) => {
    const item = element("li"), form = element("fieldset"), answer = element("p", "", {className: "answer"});
    answer.setAttribute("role", "status");
    form.append(element("legend", question.text));
    const where = element("button", `mark pixel ${question.x}, ${question.y}`, {type: "button", className: "quiet"});
    where.addEventListener("click", () => show(question, Math.max(0, question.step - 1)));
    const choices = question.choices.map((text, choice) => {
      const button = element("button", text, {type: "button"});
      button.dataset.choice = choice;
      button.addEventListener("click", () => {
        const right = choice === question.answer;
        choices.forEach((each, n) => each.classList.toggle("right", n === question.answer));
        answer.textContent = `${right ? "Right" : "Not so"}: ${question.explanation}`;
        item.dataset.answered = right ? "right" : "wrong";
        show(question, question.step);
      });
      return button;
    });
    const row = element("div", "", {className: "choices"});
    row.append(...choices, where);
    form.append(row, answer);
    form.id = `question-${number}`;
    item.append(form);
    items.append(item);
  });
}
